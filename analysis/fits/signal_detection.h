#pragma once

#include <cstdint>
#include <utility>

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
  /// Of d' and c, each rate being a binomial proportion (Gourevitch and Galanter 1967).
  double d_prime_standard_error = 0.0, criterion_standard_error = 0.0;
  /// A' of the rates without correction (Pollack and Norman 1964; Grier 1971), 0.5 where they
  /// are equal: no distribution is assumed, but it is no area under a curve either.
  double a_prime = 0.5;

  [[nodiscard]] std::pair<double, double> d_prime_ci95() const noexcept;
  [[nodiscard]] std::pair<double, double> criterion_ci95() const noexcept;
};

/// Throws `core::Error` for counts that cannot be.
[[nodiscard]] SignalDetection signal_detection(const DetectionCounts& counts);

}  // namespace jnd::analysis
