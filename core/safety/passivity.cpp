#include "core/safety/passivity.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::core {

PassivityController::PassivityController(const Parameters& parameters, double period_s)
    : max_credit_j_(parameters.max_credit_j), period_s_(period_s) {
  require_positive(max_credit_j_, "max_credit_j");
  require_positive(period_s_, "period_s");
}

bool PassivityController::control(const PointVectors& tip_position_m,
                                  const PointVectors& tip_velocity_m_per_s,
                                  PointVectors& force_on_hand_n) noexcept {
  bool changed = false;
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (has_last_) {
      const double put_in_j = -last_force_n_[i].dot(tip_position_m[i] - last_position_m_[i]);
      if (std::isfinite(put_in_j)) {
        credit_j_[i] = std::min(credit_j_[i] + put_in_j, max_credit_j_);
      }
    }
    const double pushing_w = force_on_hand_n[i].dot(tip_velocity_m_per_s[i]);
    const double deficit_w = pushing_w - credit_j_[i] / period_s_;
    // Only a push along the motion gives energy; NaN is left to the limiter. Below this speed,
    // which no hand can tell from rest, a push gives nothing, and dividing by the square would
    // be inexact.
    constexpr double kRestM2PerS2 = 1e-12;
    const double speed_squared = tip_velocity_m_per_s[i].squaredNorm();
    if (pushing_w > 0.0 && deficit_w > 0.0 && speed_squared > kRestM2PerS2) {
      const double removed_w = std::min(deficit_w, pushing_w);
      force_on_hand_n[i] -= (removed_w / speed_squared) * tip_velocity_m_per_s[i];
      changed = true;
    }
  }
  last_position_m_ = tip_position_m;
  has_last_ = true;
  return changed;
}

void PassivityController::grant_credit(std::uint8_t storing_bits) noexcept {
  for (int i = 0; i < kNumContactPoints; ++i) {
    if ((storing_bits >> i & 1) != 0) credit_j_[i] = max_credit_j_;
  }
}

void PassivityController::reset() noexcept {
  has_last_ = false;
  credit_j_.fill(0.0);
  last_force_n_ = zero_vectors();
}

}  // namespace jnd::core
