#pragma once

#include <functional>

#include "core/exchange/haptic_command.h"
#include "device/haptic_device.h"

namespace jnd::device {

/// When a loop counts as stable: after one disturbance, in the last `judged_s` of a run,
///   - no tip is faster than `rest_speed_m_per_s`, nor than `rest_ratio` of the highest speed
///     there was before;
///   - no component of any point's force changes by more than `force_swing_n`: chatter within
///     the limits, however little the tips follow;
///   - the limiter changes the force in at most `limited_ratio` of the ticks: chatter at them;
/// and the loop never latched a fault. What decays too slowly to get there counts as unstable,
/// so a limit found this way errs to the safe side.
struct SettlingCriterion {
  double duration_s = 1.2;  ///< Of the run, > 0.
  double judged_s = 0.3;    ///< (0, duration_s).
  double rest_speed_m_per_s = 0.01;
  double rest_ratio = 0.1;
  double force_swing_n = 0.5;
  double limited_ratio = 0.01;
};

/// Opens the device, which brings its own disturbance within the first part of the run, and
/// runs a whole `HapticLoop` on it, limiter and passivity included, with this medium from the
/// first tick on. Throws `core::Error` for a rate that device or loop cannot do. Not real time.
[[nodiscard]] bool settles(HapticDevice& device, const core::HapticCommand& command,
                           double rate_hz, const SettlingCriterion& criterion = {});

/// Where to look for the largest stable value: upwards from `first` by `step_ratio` until a
/// value is unstable, at most to `last`, then by bisection down to `resolution_ratio`. So an
/// island of stable values beyond the first unstable rung does not count.
struct StabilityLadder {
  double first;                    ///< > 0.
  double last;                     ///< >= first.
  double step_ratio = 2.0;         ///< > 1.
  double resolution_ratio = 1.03;  ///< > 1.
};

struct StabilityLimit {
  double value = 0.0;  ///< The largest found stable; 0: not even the first one was.
  /// Nothing unstable was found up to the ladder's last value, which is `value`.
  bool is_beyond_ladder = false;
};

/// Calls `is_stable` for one value after the other. Throws `core::Error` naming the field of a
/// ladder that leads nowhere. Not real time.
[[nodiscard]] StabilityLimit largest_stable(const StabilityLadder& ladder,
                                            const std::function<bool(double)>& is_stable);

}  // namespace jnd::device
