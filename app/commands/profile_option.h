#pragma once

#include <string>

namespace CLI {
class App;
}

namespace jnd::app {

/// `--profile FILE`: what was measured of the device.
void add_profile_option(CLI::App& command, std::string& file);

}  // namespace jnd::app
