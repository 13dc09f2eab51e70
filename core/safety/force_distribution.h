#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/hand.h"
#include "core/haptic_state.h"

namespace jnd::core {

/// Spreads the drag on the whole hand over the contact points (thesis, B.5 and C.2):
///
///   force_i = share_i drag immersed_i attached_i (-v_i / max(|v_i|, fade_speed))
///
/// The magnitude comes from the mean motion, the direction from the point's own motion. Below
/// `fade_speed` the force of a point fades with its speed, so that it is continuous if one tip
/// stops while the hand moves on. It never acts along a point's motion: force_i . v_i <= 0.
///
/// `drag_n` >= 0; `shares` is as in `ShareRatios`; bit i of `immersed_bits` and
/// `state.attached[i]` decide on point i; `fade_speed_m_per_s` > 0. The forces act on the hand,
/// in the workspace frame. Real time.
inline void distribute_drag(double drag_n, const ShareRatios& shares, const HapticState& state,
                            std::uint8_t immersed_bits, double fade_speed_m_per_s,
                            PointVectors& force_on_hand_n) noexcept {
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (!state.attached[i] || (immersed_bits >> i & 1) == 0) {
      force_on_hand_n[i].setZero();
      continue;
    }
    const Eigen::Vector3d& velocity = state.tip_velocity_m_per_s[i];
    const double speed = std::max(std::sqrt(velocity.squaredNorm()), fade_speed_m_per_s);
    force_on_hand_n[i] = (-shares[i] * drag_n / speed) * velocity;
  }
}

}  // namespace jnd::core
