#include "core/safety/staleness.h"

#include <algorithm>

namespace jnd::core {

void Staleness::observe(const HapticState& state, const HapticState& last, double elapsed_s,
                        std::int64_t num_missed) noexcept {
  const bool time_stands = elapsed_s <= 0.0;
  num_still_ = time_stands ? num_still_ + 1 + num_missed : 0;
  is_stuck_ = moves_without_getting_anywhere(state, last, elapsed_s, num_missed);
  num_missed_ = time_stands || num_stuck_ > 0 ? num_missed_ + num_missed : 0;
}

/// Returns true if the positions stand still for more ticks than a measurement may be reused,
/// while the velocity implies a displacement that exceeds both an encoder step and what a
/// velocity filter reports just after the hand stopped.
bool Staleness::moves_without_getting_anywhere(const HapticState& state,
                                               const HapticState& last, double elapsed_s,
                                               std::int64_t num_missed) noexcept {
  constexpr double kMovingMPerS = 0.05;
  constexpr double kStuckWayM = 0.003;
  // A reused measurement says nothing new.
  if (elapsed_s <= 0.0) {
    num_stuck_ += num_stuck_ > 0 ? 1 + num_missed : 0;
    return false;
  }
  // A clock of the device's that leaps adds no more than that and what the loop missed.
  const double most_s = longest_s() + static_cast<double>(num_missed) * period_s_;
  double most_way_m = 0.0;
  for (int i = 0; i < kNumContactPoints; ++i) {
    const double speed_m_per_s = state.tip_velocity_m_per_s[i].norm();
    const bool is_stuck = state.attached[i] && last.attached[i] &&
                          speed_m_per_s > kMovingMPerS &&
                          state.tip_position_m[i] == last.tip_position_m[i];
    stuck_way_m_[i] =
        is_stuck ? stuck_way_m_[i] + std::min(elapsed_s, most_s) * speed_m_per_s : 0.0;
    most_way_m = std::max(most_way_m, stuck_way_m_[i]);
  }
  num_stuck_ = most_way_m > 0.0 ? num_stuck_ + 1 + num_missed : 0;
  return num_stuck_ > max_ticks_ && most_way_m > kStuckWayM;
}

void Staleness::reset() noexcept {
  is_stuck_ = false;
  num_still_ = 0;
  num_stuck_ = 0;
  stuck_way_m_.fill(0.0);
}

}  // namespace jnd::core
