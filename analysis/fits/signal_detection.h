#pragma once

#include <cstdint>

namespace jnd::analysis {

/// "Yes" to stimuli, and to catch trials without any.
struct DetectionCounts {
  std::int64_t num_hits = 0, num_signals = 0;        ///< 0 <= hits <= signals, >= 1 signal.
  std::int64_t num_false_alarms = 0, num_catch = 0;  ///< "Yes" and trials without a stimulus.
};

/// Sensitivity and criterion of the equal-variance normal model (Green and Swets 1966):
///
///     d' = z(H) - z(F),   c = -(z(H) + z(F)) / 2,
///
/// z being the standard normal quantile. Half an answer is added to all counts of "yes" and one
/// trial to all numbers of trials, so that rates of 0 and 1 have a z, and none is treated apart
/// (the log-linear correction of Hautus 1995).
struct SignalDetection {
  double hit_rate = 0.0, false_alarm_rate = 0.0;  ///< Corrected, in (0, 1).
  double d_prime = 0.0;
  double criterion = 0.0;  ///< c: > 0 is reluctant to say "yes".
};

/// Throws `core::Error` for counts that cannot be.
[[nodiscard]] SignalDetection signal_detection(const DetectionCounts& counts);

}  // namespace jnd::analysis
