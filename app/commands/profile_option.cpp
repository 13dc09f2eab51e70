#include "app/commands/profile_option.h"

#include <CLI/CLI.hpp>

namespace jnd::app {

void add_profile_option(CLI::App& command, std::string& file) {
  command.add_option("--profile", file,
                     "What was measured of the device, NAME.device.json; default: a real "
                     "device's own, where it is found");
}

}  // namespace jnd::app
