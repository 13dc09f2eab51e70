#pragma once

#include <span>

#include "core/haptic_state.h"
#include "device/check/device_rule.h"

namespace jnd::device {

inline constexpr DeviceRule kSlowVelocity = {
    "slow_velocity", "Velocities are at most 15 ms behind the positions.",
    "Filter the velocity less, for every force is computed from it: a low-pass of first order "
    "at 40 Hz is 4 ms behind."};

/// How late velocities are by the positions of the same measurements.
struct VelocityLag {
  double lag_s = 0.0;
  double moved_m = 0.0;      ///< Between the extremes; of less than 0.5 mm nothing is known.
  bool is_known = false;     ///< It moved enough, and at some lag both agree.
  bool is_too_late = false;  ///< More than 15 ms, and the agreement is clearly better there.
};

/// Along one axis of one point. The way that velocities add up to is moved against the
/// positions until both agree best. A velocity of another size or direction agrees nowhere, and
/// is not called late: that is another rule's. Not real time.
[[nodiscard]] VelocityLag velocity_lag(std::span<const core::HapticState> states,
                                       std::size_t point, int axis);

/// Judges the axis that moved most of those that were seen.
class VelocityLagJudge {
 public:
  void observe(std::span<const core::HapticState> states, std::size_t point);
  void judge(RuleJudge& judge) const;

 private:
  VelocityLag most_;
};

}  // namespace jnd::device
