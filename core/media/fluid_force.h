#pragma once

#include <cstdint>

#include "core/haptic_state.h"
#include "core/media/medium.h"

namespace jnd::core {

/// What a medium's fluid does to the points, workspace frame, before any limit: the sum of
///
///   drag:      `MediumAmounts::drag_n` spread by `distribute_drag`;
///   ellipsoid: -share R diag(k) R^T v_i with the hand's axes R, against each point's own
///              velocity, so it never gives energy. Where the hand plane is not defined, the
///              mean of the three k;
///   lift:      share amount C_L(alpha_i) speed^2 with the hand's speed and the point's own
///              angle of attack, at right angles to its velocity in the plane of it and the
///              hand plane's normal, to the side to which a flat plate is driven: away from
///              where it meets the fluid. force . v_i = 0, so it gives no energy either. It
///              fades like drag below the fade speed. Without a map there is none;
///   buoyancy:  upward, share buoyancy min(1, depth / 3 cm), so that the surface is no step.
///              Pushed down the hand stores energy, of which `PassivityController` gives back
///              what was put in, at most its credit: a hand that begins below is held against
///              its weight but not driven up, and one lifted from deeper than credit / force
///              loses it on the way.
///
/// Zero for a point that is not attached or not immersed. `surface_z_m` is the fluid's surface,
/// `fade_speed_m_per_s` > 0 as in `distribute_drag`. Real time.
void add_up_fluid_force(const MediumAmounts& medium, const ForceMap* map,
                        const HandMotion& motion, const ShareRatios& shares,
                        const HapticState& state, std::uint8_t immersed_bits,
                        double surface_z_m, double fade_speed_m_per_s,
                        PointVectors& force_on_hand_n) noexcept;

}  // namespace jnd::core
