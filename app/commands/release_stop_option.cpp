#include "app/commands/release_stop_option.h"

#include <CLI/CLI.hpp>

namespace jnd::app {

void add_release_stop_option(CLI::App& command, bool& releases) {
  command.add_flag("--release-stop", releases,
                   "Of a real device: release an emergency stop that was pressed in an earlier "
                   "run; somebody is beside the device and has seen to the reason");
}

}  // namespace jnd::app
