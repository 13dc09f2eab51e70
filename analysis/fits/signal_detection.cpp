#include "analysis/fits/signal_detection.h"

#include <algorithm>
#include <cmath>

#include "analysis/fits/normal_tail.h"
#include "core/psychometric_function.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

double corrected_rate(std::int64_t num_yes, std::int64_t num_trials) {
  return (static_cast<double>(num_yes) + 0.5) / (static_cast<double>(num_trials) + 1.0);
}

/// The variance of z of a rate over `num_trials` trials.
double variance_of_z(double rate, double z, double num_trials) {
  const double density = normal_tails(z).density;
  return rate * (1.0 - rate) / (num_trials * density * density);
}

double a_prime_of(double hit, double false_alarm) {
  if (hit == false_alarm) return 0.5;
  const double more = std::max(hit, false_alarm), less = std::min(hit, false_alarm);
  const double beyond = (more - less) * (1.0 + more - less) / (4.0 * more * (1.0 - less));
  return hit > false_alarm ? 0.5 + beyond : 0.5 - beyond;
}

std::pair<double, double> about(double value, double standard_error) noexcept {
  constexpr double kNormalQuantile = 1.9599639845400545;
  return {value - kNormalQuantile * standard_error, value + kNormalQuantile * standard_error};
}

}  // namespace

std::pair<double, double> SignalDetection::d_prime_ci95() const noexcept {
  return about(d_prime, d_prime_standard_error);
}
std::pair<double, double> SignalDetection::criterion_ci95() const noexcept {
  return about(criterion, criterion_standard_error);
}

SignalDetection signal_detection(const DetectionCounts& counts) {
  core::require(counts.num_signals >= 1 && counts.num_catch >= 1, "num_trials",
                "one or more with a stimulus and without",
                static_cast<double>(std::min(counts.num_signals, counts.num_catch)));
  core::require(counts.num_hits >= 0 && counts.num_hits <= counts.num_signals, "num_hits",
                "0 to the number of stimuli", static_cast<double>(counts.num_hits));
  core::require(counts.num_false_alarms >= 0 && counts.num_false_alarms <= counts.num_catch,
                "num_false_alarms", "0 to the number of catch trials",
                static_cast<double>(counts.num_false_alarms));
  SignalDetection found{
      .hit_rate = corrected_rate(counts.num_hits, counts.num_signals),
      .false_alarm_rate = corrected_rate(counts.num_false_alarms, counts.num_catch)};
  const double hit = core::standard_normal_quantile(found.hit_rate);
  const double false_alarm = core::standard_normal_quantile(found.false_alarm_rate);
  found.d_prime = hit - false_alarm;
  found.criterion = -0.5 * (hit + false_alarm);
  const auto num_signals = static_cast<double>(counts.num_signals);
  const auto num_catch = static_cast<double>(counts.num_catch);
  found.d_prime_standard_error =
      std::sqrt(variance_of_z(found.hit_rate, hit, num_signals + 1.0) +
                variance_of_z(found.false_alarm_rate, false_alarm, num_catch + 1.0));
  found.criterion_standard_error = 0.5 * found.d_prime_standard_error;
  found.a_prime = a_prime_of(static_cast<double>(counts.num_hits) / num_signals,
                             static_cast<double>(counts.num_false_alarms) / num_catch);
  return found;
}

}  // namespace jnd::analysis
