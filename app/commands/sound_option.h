#pragma once

#include <string>

#include "app/sound/sound_settings.h"
#include "experiments/study/study.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace jnd::app {

/// Adds `--sound OUTPUT|off`.
CLI::Option* add_sound_option(CLI::App& command, std::string& output);

/// Throws `UsageError` if the study requires its sound and `output` is "off", because then no
/// session would begin.
void require_sound_fits(const experiments::Study& study, const std::string& output);

}  // namespace jnd::app
