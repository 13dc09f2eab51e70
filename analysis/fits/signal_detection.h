#pragma once

#include <cstdint>
#include <utility>

namespace jnd::analysis {

/// Counts of "yes" to stimuli, and to catch trials without a stimulus.
struct DetectionCounts {
  /// 0 <= hits <= signals, and signals >= 1.
  std::int64_t num_hits = 0, num_signals = 0;
  /// The number of "yes" to catch trials, and of catch trials.
  std::int64_t num_false_alarms = 0, num_catch = 0;
};

/// Sensitivity and criterion of the equal-variance normal model (Green and Swets 1966):
///
///     d' = z(H) - z(F),   c = -(z(H) + z(F)) / 2
///
/// z is the standard normal quantile. Half an answer is added to every count of "yes" and one
/// trial to every number of trials, so that rates of 0 and 1 have a z (the log-linear
/// correction of Hautus 1995).
struct SignalDetection {
  double hit_rate = 0.0, false_alarm_rate = 0.0;  ///< The corrected rates, in (0, 1).
  double d_prime = 0.0;
  /// The criterion c. It is > 0 for a person who is reluctant to say "yes".
  double criterion = 0.0;
  /// The standard errors of d' and c, with each rate as a binomial proportion (Gourevitch and
  /// Galanter 1967).
  double d_prime_standard_error = 0.0, criterion_standard_error = 0.0;
  /// A' of the uncorrected rates (Pollack and Norman 1964; Grier 1971). It is 0.5 if they are
  /// equal. A' assumes no distribution, but it is not the area under a curve either.
  double a_prime = 0.5;

  [[nodiscard]] std::pair<double, double> d_prime_ci95() const noexcept;
  [[nodiscard]] std::pair<double, double> criterion_ci95() const noexcept;
};

/// Throws `core::Error` for impossible counts.
[[nodiscard]] SignalDetection signal_detection(const DetectionCounts& counts);

}  // namespace jnd::analysis
