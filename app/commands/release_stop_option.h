#pragma once

namespace CLI {
class App;
}

namespace jnd::app {

/// `--release-stop`: an emergency stop that was pressed in an earlier run is released.
void add_release_stop_option(CLI::App& command, bool& releases);

}  // namespace jnd::app
