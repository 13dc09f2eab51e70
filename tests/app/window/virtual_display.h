#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace jnd::app {

/// How a tool ended.
struct ToolOutcome {
  int exit_code = -1;  ///< -1 if the tool could not be started or a signal ended it.
  std::string out;     ///< All that the tool wrote, including error messages.
};

/// Runs a program of the system on this display and waits for its end. If `display` is "", the
/// program has no display.
[[nodiscard]] ToolOutcome run_tool(const std::vector<std::string>& words,
                                   const std::string& display);

/// Gives this process and its children priority, where the system allows it. A window that is
/// not drawn for 250 ms stops the force, and without a graphics card this happens on a busy
/// machine. The process moves to a session of its own, because the priority of the shell's
/// session would stay changed.
void go_first();

/// Returns why no window can be driven here, or "" if one can.
[[nodiscard]] std::string what_windows_lack();

/// A display in memory that each test has for itself: Xvfb on a free number, which ends with
/// the test. A held key repeats after 0.25 s, 25 times a second.
class VirtualDisplay {
 public:
  /// Throws `std::runtime_error` if the display does not start.
  VirtualDisplay(int width_px, int height_px);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// Returns the name of the display, for example ":12".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Ends the display abruptly, as when its cable is cut.
  void lose();

 private:
  pid_t pid_ = -1;
  std::string name_;
};

}  // namespace jnd::app
