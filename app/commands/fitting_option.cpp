#include "app/commands/fitting_option.h"

#include <CLI/CLI.hpp>

#include "app/command_line/command.h"
#include "app/session/fitting.h"
#include "core/error.h"

namespace jnd::app {

void add_fitting_option(CLI::App& command, std::vector<std::string>& given) {
  command
      .add_option("--fitting", given,
                  "How the device was fitted to the participant, as glove=M or thumb=\"thin "
                  "pad\"; kept with the points that are held and where they rest")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

std::map<std::string, std::string> fitting_given(const std::vector<std::string>& given) {
  try {
    return fitting_of(given, "--fitting");
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace jnd::app
