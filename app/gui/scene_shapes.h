#pragma once

#include "app/gui/robot_scene.h"

namespace jnd::app::gui {

// Single shapes for `RobotScene`. Each is appended to a scene if the scene has room.

[[nodiscard]] bool is_finite(const core::PlainVector& vector) noexcept;

void add_ball(mjvScene_& scene, const core::PlainVector& at_m, double radius_m,
              const SceneColour& colour);
void add_box(mjvScene_& scene, const core::PlainVector& at_m, const core::PlainVector& half_m,
             const SceneColour& colour, float opacity = 1.0f);
/// Draws an arrow from the point along the force; none if it is shorter than 1 mm or not
/// finite.
void add_arrow(mjvScene_& scene, const core::PlainVector& at_m,
               const core::PlainVector& force_n, double m_per_n, const SceneColour& colour);
/// Draws palm, thumb, index and middle finger, and a piece of the forearm, between the points
/// that hold the hand.
void add_hand_shapes(mjvScene_& scene, const core::Sample& sample);
/// Draws the surface as a plane or disc, translucent for a fluid and more opaque for a solid,
/// and the walls and floor.
void add_fluid_shapes(mjvScene_& scene, const SurroundingsView& surroundings,
                      const SceneColours& colours);

}  // namespace jnd::app::gui
