#include "app/commands/sound_option.h"

#include <CLI/CLI.hpp>

#include "app/command_line/command.h"

namespace jnd::app {

CLI::Option* add_sound_option(CLI::App& command, std::string& output) {
  return command
      .add_option("--sound", output,
                  "In the window: where the study's masking noise and cues are played, as "
                  "`jnd sound` lists outputs, or off; default: this machine's own")
      ->type_name("OUTPUT|off");
}

void require_sound_fits(const experiments::Study& study, const std::string& output) {
  if (output != kSoundOff || !experiments::requires_sound(study)) return;
  throw UsageError("--sound: expected an output, for " + study.name +
                   " requires its sound, found `off`; `jnd sound` lists the outputs");
}

}  // namespace jnd::app
