#include "analysis/fits/signal_detection.h"

#include <algorithm>

#include "core/psychometric_function.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

double corrected_rate(std::int64_t num_yes, std::int64_t num_trials) {
  return (static_cast<double>(num_yes) + 0.5) / (static_cast<double>(num_trials) + 1.0);
}

}  // namespace

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
  return found;
}

}  // namespace jnd::analysis
