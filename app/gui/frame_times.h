#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace jnd::app::gui {

/// What each frame cost, one a line, for measurements:
///     VIEW DRAW_MS RENDER_MS SHOW_MS
/// the view's own work, OpenGL until it is through, and the way to the display. Flushed at
/// once.
class FrameTimes {
 public:
  enum class Part { kDraw, kRender, kShow };

  /// An empty path switches it off. Throws `core::Error` where the file cannot be appended to.
  explicit FrameTimes(const std::filesystem::path& file);

  /// Somebody measures: OpenGL shall be waited for.
  [[nodiscard]] bool wanted() const { return out_.is_open(); }
  void begin_frame();
  /// The part ends here, and the next one begins.
  void end(Part part);
  void end_frame(std::string_view view);

 private:
  std::ofstream out_;
  std::chrono::steady_clock::time_point part_began_;
  double cpu_began_ms_ = 0.0;
  std::array<double, 3> ms_{};
};

}  // namespace jnd::app::gui
