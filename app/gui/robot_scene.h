#pragma once

#include <array>
#include <memory>
#include <vector>

#include "app/gui/scene_camera.h"
#include "app/gui/theme.h"
#include "app/operator/surroundings_view.h"
#include "core/sample.h"
#include "device/exoskeleton/mujoco_guard.h"

struct mjvScene_;

namespace jnd::app::gui {

/// Red, green, blue; 0 to 1.
using SceneColour = std::array<float, 3>;

struct SceneColours {
  SceneColour ground, force, in_fluid, dry, loose, surface, solid;

  friend bool operator==(const SceneColours&, const SceneColours&) = default;
};

/// Those of the plots: forces amber, what is loose purple. What a colour says, a shape does,
/// too.
[[nodiscard]] SceneColours scene_colours(const Theme& theme);

/// A force of 1 N is an arrow of this length.
inline constexpr double kArrow_m_per_n = 0.03;

/// The apparatus as shapes in space, workspace frame, made of one sample: the robot where the
/// joints and the end effector say, the hand between its tips, the forces on it, the surface.
/// A picture of its own of the model, without any physics and none of the loop's data. Whatever
/// is not finite is left out; joints that the model does not know, as well.
///
/// Points: a ball in the fluid, a smaller one outside of it, a box where the finger came off.
class RobotScene {
 public:
  /// Throws `core::Error` where the model cannot be read.
  RobotScene();
  ~RobotScene();
  RobotScene(const RobotScene&) = delete;
  RobotScene& operator=(const RobotScene&) = delete;

  void show(const core::Sample& sample, const SurroundingsView& surroundings,
            const SceneColours& colours, const SceneCamera& camera);

  // For whoever draws it with MuJoCo's renderer, and for tests.
  [[nodiscard]] mjModel_& model() noexcept { return *model_; }
  [[nodiscard]] const mjData_& data() const noexcept { return *data_; }
  [[nodiscard]] mjvScene_& scene() noexcept { return *scene_; }
  /// Of the background, which changes with the colours; -1 for none.
  [[nodiscard]] int background_texture() const noexcept { return background_texture_; }

 private:
  struct Addresses;
  void look_up_names();
  void place_robot(const core::Sample& sample);
  void add_points(const core::Sample& sample, const SceneColours& colours);

  device::MujocoModel model_;
  device::MujocoData data_;
  std::unique_ptr<mjvScene_> scene_;
  std::unique_ptr<Addresses> addresses_;
  int background_texture_ = -1;
};

}  // namespace jnd::app::gui
