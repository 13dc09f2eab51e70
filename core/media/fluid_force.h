#pragma once

#include <cstdint>

#include "core/haptic_state.h"
#include "core/media/medium.h"

namespace jnd::core {

/// Adds the forces of a medium's fluid on the points, in the workspace frame, before any limit.
/// The force on a point is a sum:
///
///   drag:      `MediumAmounts::drag_n`, spread by `distribute_drag`.
///   ellipsoid: -share R diag(k) R^T v_i with the hand's axes R. It acts against each point's
///              own velocity, so it never gives energy. Without a hand plane, the mean of the
///              three k is used.
///   lift:      share amount C_L(alpha_i) speed^2, with the hand's speed and the point's own
///              angle of attack. It is at right angles to the point's velocity, in the plane of
///              the velocity and the hand plane's normal. It points to the side to which a flat
///              plate is driven, away from where the plate meets the fluid. force . v_i = 0, so
///              it gives no energy either. It fades like drag below the fade speed. Without a
///              map there is no lift.
///   buoyancy:  upward, share buoyancy min(1, depth / 3 cm), so that the surface is no step. A
///              hand that is pushed down stores energy. `PassivityController` lets it give back
///              what was put in, up to its credit. So a hand that begins below the surface is
///              held against its weight but not driven up, and one that is lifted from deeper
///              than credit / force loses the buoyancy on the way.
///
/// The force is zero for a point that is not attached or not immersed. `surface_z_m` is the
/// height of the fluid's surface, and `fade_speed_m_per_s` > 0 is as in `distribute_drag`. Real
/// time.
void add_up_fluid_force(const MediumAmounts& medium, const ForceMap* map,
                        const HandMotion& motion, const ShareRatios& shares,
                        const HapticState& state, std::uint8_t immersed_bits,
                        double surface_z_m, double fade_speed_m_per_s,
                        PointVectors& force_on_hand_n) noexcept;

}  // namespace jnd::core
