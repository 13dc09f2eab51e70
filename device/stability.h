#pragma once

#include <functional>

#include "core/exchange/haptic_command.h"
#include "device/haptic_device.h"

namespace jnd::device {

/// When a loop counts as stable. After one disturbance, in the last `judged_s` of a run:
/// - no tip is faster than `rest_speed_m_per_s`, nor than `rest_ratio` of the highest speed
///   before;
/// - no component of any point's force changes by more than `force_swing_n`, which would be
///   chatter within the limits, however little the tips follow;
/// - the limiter changes the force in at most `limited_ratio` of the ticks; more would be
///   chatter at the limits;
/// - the loop never latched a fault.
///
/// A motion that decays too slowly counts as unstable, so a limit found in this way errs on the
/// safe side.
struct SettlingCriterion {
  double duration_s = 1.2;  ///< Duration of the run, > 0.
  double judged_s = 0.3;    ///< (0, duration_s).
  double rest_speed_m_per_s = 0.01;
  double rest_ratio = 0.1;
  double force_swing_n = 0.5;
  double limited_ratio = 0.01;
};

/// Opens the device, which adds its own disturbance in the first part of the run. Runs a
/// complete `HapticLoop` on it, with limiter and passivity, and with this medium from the first
/// tick on. Throws `core::Error` for a rate that device or loop cannot use. Not real time.
[[nodiscard]] bool settles(HapticDevice& device, const core::HapticCommand& command,
                           double rate_hz, const SettlingCriterion& criterion = {});

/// Where to look for the largest stable value. The search goes upwards from `first` by
/// `step_ratio` until a value is unstable, at most to `last`, and then bisects down to
/// `resolution_ratio`. So stable values beyond the first unstable one do not count.
struct StabilityLadder {
  double first;                    ///< > 0.
  double last;                     ///< >= first.
  double step_ratio = 2.0;         ///< > 1.
  double resolution_ratio = 1.03;  ///< > 1.
};

struct StabilityLimit {
  double value = 0.0;  ///< The largest stable value; 0 if not even the first one was stable.
  /// All values up to the ladder's last one were stable, and `value` is the last one.
  bool is_beyond_ladder = false;
};

/// Calls `is_stable` for one value after another. Throws `core::Error` naming the field of an
/// invalid ladder. Not real time.
[[nodiscard]] StabilityLimit largest_stable(const StabilityLadder& ladder,
                                            const std::function<bool(double)>& is_stable);

}  // namespace jnd::device
