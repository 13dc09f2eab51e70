#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace jnd::app {

/// What a tool came to.
struct ToolOutcome {
  int exit_code = -1;  ///< -1 if it could not be started, or a signal ended it.
  std::string out;     ///< All it wrote, complaints included.
};

/// Runs a program of the system to its end, on this display; "" for none.
[[nodiscard]] ToolOutcome run_tool(const std::vector<std::string>& words,
                                   const std::string& display);

/// Has this process and whatever it starts run before others, where the system allows it: a
/// window that is not drawn for 250 ms stops the force, and on a machine full of compilers one
/// without a graphics card would be such a window. Into a session of its own, for a shell's
/// would stay like that.
void go_first();

/// Why no window can be driven here: "" if one can.
[[nodiscard]] std::string what_windows_lack();

/// A screen that nobody sees, of its own for every test: Xvfb on a free display, gone with the
/// test. A held key repeats after 0.25 s, 25 times a second.
class VirtualDisplay {
 public:
  /// Throws `std::runtime_error` if it does not start.
  VirtualDisplay(int width_px, int height_px);
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  /// ":12"
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// As when its cable is cut.
  void lose();

 private:
  pid_t pid_ = -1;
  std::string name_;
};

}  // namespace jnd::app
