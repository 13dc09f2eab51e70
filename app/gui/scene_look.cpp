#include "app/gui/scene_look.h"

#include <algorithm>

namespace jnd::app::gui {
namespace {

constexpr double kBetweenPictures_s = 0.1;
// Scales both sides, which halves the number of pixels.
constexpr double kSoftwareScale = 0.7;

}  // namespace

SceneLook look_of(const SceneRequest& request, bool is_software) noexcept {
  const double width = std::max(request.width_px, 1);
  const double height = std::max(request.height_px, 1);
  const double scale = std::min({is_software ? kSoftwareScale : 1.0, kMostSceneWidth_px / width,
                                 kMostSceneHeight_px / height});
  const auto scaled = [&](double px) { return std::max(1, static_cast<int>(scale * px)); };
  return {.tick = request.sample.tick,
          .camera = request.camera,
          .colours = request.colours,
          .width_px = scaled(width),
          .height_px = scaled(height)};
}

bool ScenePace::takes(const SceneLook& wanted, double now_s) noexcept {
  // A change between light and dark shows at once, together with everything around.
  const bool is_recent =
      now_s < drawn_s_ + kBetweenPictures_s && drawn_.colours == wanted.colours;
  if (has_drawn_ && (is_recent || drawn_ == wanted)) return false;
  drawn_ = wanted;
  drawn_s_ = now_s;
  has_drawn_ = true;
  return true;
}

}  // namespace jnd::app::gui
