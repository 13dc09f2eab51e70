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
  double moved_m = 0.0;  ///< Between the extremes; of less than 0.5 mm nothing is known.
  /// How much the longest lag that is tried would show. Movement at an even speed shows none.
  double shown_m = 0.0;
  /// It moved enough, and at some lag both agree: up to 15 ms, or clearly better than without.
  bool is_known = false;
  bool is_too_late = false;  ///< It is known, and more than 15 ms.
};

/// Along one axis of one point. The way that velocities add up to is moved against the
/// positions until both agree best. A velocity of another size or direction agrees nowhere, and
/// is not called late: that is another rule's. Not real time.
[[nodiscard]] VelocityLag velocity_lag(std::span<const core::HapticState> states,
                                       std::size_t point, int axis);

/// Judges the axis, of those that were seen, whose movement shows a lag best.
class VelocityLagJudge {
 public:
  void observe(std::span<const core::HapticState> states, std::size_t point);
  void judge(RuleJudge& judge) const;

 private:
  VelocityLag clearest_;
};

}  // namespace jnd::device
