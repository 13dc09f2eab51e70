#pragma once

#include "app/gui/robot_scene.h"

namespace jnd::app::gui {

// For `RobotScene` alone: single shapes, appended to a scene as far as it has room.

[[nodiscard]] bool is_finite(const core::PlainVector& vector) noexcept;

void add_ball(mjvScene_& scene, const core::PlainVector& at_m, double radius_m,
              const SceneColour& colour);
void add_box(mjvScene_& scene, const core::PlainVector& at_m, const core::PlainVector& half_m,
             const SceneColour& colour, float opacity = 1.0f);
/// From the point along the force; none for less than 1 mm or what is not finite.
void add_arrow(mjvScene_& scene, const core::PlainVector& at_m,
               const core::PlainVector& force_n, double m_per_n, const SceneColour& colour);
/// Palm, thumb, index and middle finger and a piece of the forearm, between the points that
/// hold the hand.
void add_hand_shapes(mjvScene_& scene, const core::Sample& sample);
/// The surface as a translucent plane or disc, opaque where it is solid; walls and floor.
void add_fluid_shapes(mjvScene_& scene, const SurroundingsView& surroundings,
                      const SceneColours& colours);

}  // namespace jnd::app::gui
