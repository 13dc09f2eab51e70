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

/// Red, green and blue, each from 0 to 1.
using SceneColour = std::array<float, 3>;

struct SceneColours {
  SceneColour ground, force, in_fluid, dry, loose, surface, solid;

  friend bool operator==(const SceneColours&, const SceneColours&) = default;
};

/// The colours of the plots: forces are amber, and what is loose is purple. Whatever a colour
/// says, a shape says too.
[[nodiscard]] SceneColours scene_colours(const Theme& theme);

/// The length of the arrow that shows a force of 1 N.
inline constexpr double kArrow_m_per_n = 0.03;

/// The apparatus as shapes in space, in the workspace frame, made from one sample: the robot
/// where the joints and the end effector are, the hand between the tips, the forces on it, and
/// the surface. The scene has its own copy of the model, without any physics, and uses none of
/// the loop's data. It leaves out what is not finite, and joints that the model does not know.
///
/// A point in the fluid is a ball, a point outside of it is a smaller ball, and a box shows
/// where a finger came off.
class RobotScene {
 public:
  /// Throws `core::Error` if the model cannot be read.
  RobotScene();
  ~RobotScene();
  RobotScene(const RobotScene&) = delete;
  RobotScene& operator=(const RobotScene&) = delete;

  void show(const core::Sample& sample, const SurroundingsView& surroundings,
            const SceneColours& colours, const SceneCamera& camera);

  // For MuJoCo's renderer, and for tests.
  [[nodiscard]] mjModel_& model() noexcept { return *model_; }
  [[nodiscard]] const mjData_& data() const noexcept { return *data_; }
  [[nodiscard]] mjvScene_& scene() noexcept { return *scene_; }
  /// The texture of the background, which changes with the colours; -1 if there is none.
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
