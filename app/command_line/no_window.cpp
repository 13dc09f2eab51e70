// The program built without its window.

#include "app/command_line/command.h"
#include "app/command_line/open_window.h"

namespace jnd::app {

bool has_display() { return false; }

int open_window(const WindowRequest&) {
  throw EnvironmentError(
      "no window: this program was built without one, so it needs no display; use --headless "
      "where a command has it, `jnd --help` lists them all");
}

}  // namespace jnd::app
