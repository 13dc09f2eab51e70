#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace jnd::app {

/// Result of a tool.
struct ToolOutcome {
  int exit_code = -1;  ///< -1 if it could not be started, or a signal ended it.
  std::string out;     ///< All its output, including errors.
};

/// Runs a program of the system to its end on this display; "" for none.
[[nodiscard]] ToolOutcome run_tool(const std::vector<std::string>& words,
                                   const std::string& display);

/// Lets this process, and everything that it starts, run before others, if the system allows
/// it. A window that is not drawn for 250 ms stops the force, and on a machine that is busy
/// compiling, a window without a graphics card would be like that. The process gets a session
/// of its own, because that of a shell would keep the setting.
void go_first();

/// Returns why no window can be driven here, or "" if one can.
[[nodiscard]] std::string what_windows_lack();

/// An invisible screen of its own for every test: Xvfb on a free display, which ends with the
/// test. A held key repeats after 0.25 s, 25 times a second.
class VirtualDisplay {
 public:
  /// Throws `std::runtime_error` if the display does not start.
  VirtualDisplay(int width_px, int height_px);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// Returns the name of the display, for example ":12".
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Ends the display, as if its cable were cut.
  void lose();

 private:
  pid_t pid_ = -1;
  std::string name_;
};

}  // namespace jnd::app
