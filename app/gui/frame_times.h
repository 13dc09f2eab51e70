#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace jnd::app::gui {

/// Writes what each frame cost, for measurements. Each line is
///     VIEW DRAW_MS RENDER_MS SHOW_MS
/// that is the view's own work, OpenGL until it has finished, and the way to the display. Each
/// line is flushed at once.
class FrameTimes {
 public:
  enum class Part { kDraw, kRender, kShow };

  /// An empty path switches the measurement off. Throws `core::Error` if the file cannot be
  /// appended to.
  explicit FrameTimes(const std::filesystem::path& file);

  /// True if somebody measures; the window then waits for OpenGL to finish.
  [[nodiscard]] bool wanted() const { return out_.is_open(); }
  void begin_frame();
  /// Ends this part and begins the next one.
  void end(Part part);
  void end_frame(std::string_view view);

 private:
  std::ofstream out_;
  std::chrono::steady_clock::time_point part_began_;
  double cpu_began_ms_ = 0.0;
  std::array<double, 3> ms_{};
};

}  // namespace jnd::app::gui
