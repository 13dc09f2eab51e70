#include "analysis/planning/power_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "analysis/statistics/summary.h"
#include "analysis/statistics/wilson_interval.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

PlannedPower power_of(const std::vector<PlannedRun>& runs, std::size_t size, std::size_t test,
                      double alpha) {
  PlannedPower power{.num_runs = static_cast<std::int64_t>(runs.size())};
  double sum = 0.0;
  std::int64_t num_differences = 0;
  for (const PlannedRun& run : runs) {
    const PlannedTest& one = run.sizes[size].tests[test];
    power.num_undefined += one.p_value ? 0 : 1;
    power.num_significant += one.p_value && *one.p_value < alpha ? 1 : 0;
    if (!one.difference) continue;
    sum += *one.difference;
    ++num_differences;
  }
  if (num_differences > 0) power.mean_difference = sum / static_cast<double>(num_differences);
  power.power =
      static_cast<double>(power.num_significant) / static_cast<double>(power.num_runs);
  std::tie(power.power_low, power.power_high) =
      wilson_interval(power.num_significant, power.num_runs);
  return power;
}

std::optional<double> quantile(std::vector<double> values, double probability) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double value = percentile(values, probability);
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string percent_words(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

PlannedPrecision precision_of(const std::vector<PlannedRun>& runs, std::size_t size,
                              std::size_t estimate, const PlannedBlock& block,
                              std::size_t place) {
  PlannedPrecision precision;
  std::vector<double> values, half_widths;
  std::int64_t num_intervals = 0, num_holding = 0, num_people = 0, num_degenerate = 0;
  for (const PlannedRun& run : runs) {
    const PlannedEstimate& one = run.sizes[size].estimates[estimate];
    num_people += run.sizes[size].num_with_answers[place];
    num_degenerate += run.sizes[size].num_degenerate[place];
    if (!one.value) {
      ++precision.num_undefined;
      continue;
    }
    values.push_back(*one.value);
    const bool closed = one.ci95.low && one.ci95.high;
    half_widths.push_back(closed ? 0.5 * (*one.ci95.high - *one.ci95.low)
                                 : std::numeric_limits<double>::infinity());
    if (!closed || !block.true_value) continue;
    ++num_intervals;
    num_holding += *one.ci95.low <= *block.true_value && *block.true_value <= *one.ci95.high;
  }
  precision.median = quantile(values, 0.5);
  if (precision.median && block.true_value) {
    precision.bias = *precision.median - *block.true_value;
  }
  precision.half_width_median = quantile(half_widths, 0.5);
  precision.half_width_90 = quantile(half_widths, 0.9);
  if (num_intervals > 0) {
    precision.coverage = static_cast<double>(num_holding) / static_cast<double>(num_intervals);
    std::tie(precision.coverage_low, precision.coverage_high) =
        wilson_interval(num_holding, num_intervals);
  }
  if (num_people > 0) {
    precision.degenerate =
        static_cast<double>(num_degenerate) / static_cast<double>(num_people);
  }
  return precision;
}

}  // namespace

std::vector<PlannedSummary> summary_of_runs(const PlannedAnalysis& analysis,
                                            const std::vector<PlannedRun>& runs) {
  core::require(!runs.empty(), "runs", "a number >= 1", 0.0);
  const std::vector<PlannedName> tests = test_names(analysis);
  const std::vector<PlannedName> estimates = estimate_names(analysis);
  std::vector<PlannedSummary> summaries;
  for (std::size_t size = 0; size < analysis.sizes.size(); ++size) {
    PlannedSummary& summary = summaries.emplace_back();
    summary.num_participants = analysis.sizes[size];
    for (std::size_t test = 0; test < tests.size(); ++test) {
      summary.tests.push_back(power_of(runs, size, test, tests[test].alpha));
    }
    for (std::size_t estimate = 0; estimate < estimates.size(); ++estimate) {
      const std::size_t place = estimates[estimate].block;
      summary.estimates.push_back(
          precision_of(runs, size, estimate, analysis.blocks[place], place));
    }
    for (std::size_t block = 0; block < analysis.blocks.size(); ++block) {
      std::int64_t num_people = 0, num_at_end = 0;
      for (const PlannedRun& run : runs) {
        num_people += run.sizes[size].num_with_answers[block];
        num_at_end += run.sizes[size].num_at_grid_end[block];
      }
      summary.at_grid_end.push_back(num_people == 0 ? 0.0
                                                    : static_cast<double>(num_at_end) /
                                                          static_cast<double>(num_people));
    }
  }
  return summaries;
}

std::optional<double> true_difference(const PlannedAnalysis& analysis) {
  if (!analysis.compared) return std::nullopt;
  const auto log_log = [&](std::size_t place) {
    const std::optional<double>& w = analysis.blocks[place].true_value;
    return w ? std::log(std::log1p(*w)) : std::numeric_limits<double>::quiet_NaN();
  };
  const double difference =
      log_log(analysis.compared->first) - log_log(analysis.compared->second);
  return std::isfinite(difference) ? std::optional(difference) : std::nullopt;
}

bool nothing_differs(const PlannedAnalysis& analysis) {
  constexpr double kNothing = 0.005;
  const std::optional<double> difference = true_difference(analysis);
  return difference && std::fabs(*difference) < kNothing;
}

std::vector<std::string> planning_doubts(const PlannedAnalysis& analysis,
                                         const std::vector<PlannedSummary>& summaries,
                                         bool null_hypothesis) {
  constexpr double kTooRarely = 0.93, kTooOften = 0.07;
  const PlannedSummary& largest = summaries.back();
  const std::string at =
      ": with " + std::to_string(largest.num_participants) + " participants ";
  std::vector<std::string> doubts;
  const std::vector<PlannedName> estimates = estimate_names(analysis);
  for (std::size_t place = 0; place < estimates.size(); ++place) {
    const PlannedPrecision& one = largest.estimates[place];
    if (!one.coverage || one.coverage_high >= kTooRarely) continue;
    // The hierarchical estimate is judged instead.
    if (estimates[place].quick && analysis.hierarchical) continue;
    const bool of_comparison =
        analysis.blocks[estimates[place].block].quantity == PlannedQuantity::kWeberFraction;
    doubts.push_back(
        estimates[place].name + at + "the interval holds the true value in " +
        percent_words(*one.coverage) + " of the studies, not in 95 %. " +
        (estimates[place].quick
             ? "This is the quick estimate, which knows no lapses: plan with --hierarchical, "
               "the "
               "fit that the results will have."
             : "People of this laboratory do what the fit does not know (drift, learning, "
               "fatigue), and these stimuli let it count: plan on neither this half width nor "
               "this power, and try other stimuli" +
                   std::string(of_comparison ? ", nearer the reference." : ".")));
  }
  const bool alike = nothing_differs(analysis);
  if (alike && !null_hypothesis) {
    doubts.push_back("In this laboratory the Weber fractions of " +
                     analysis.blocks[analysis.compared->first].name + " and " +
                     analysis.blocks[analysis.compared->second].name +
                     " do not differ: the share of studies with p < 0.05 is the rate of false "
                     "positives, not a power.");
  }
  const std::vector<PlannedName> tests = test_names(analysis);
  for (std::size_t place = 0; (null_hypothesis || alike) && place < tests.size(); ++place) {
    const PlannedPower& one = largest.tests[place];
    if (tests[place].of_contrast || one.power_low <= kTooOften) continue;
    doubts.push_back(tests[place].name + at + "it finds a difference where there is none in " +
                     percent_words(one.power) +
                     " of the studies, not in 5 %: the blocks are not measured alike, and this "
                     "test must not compare them.");
  }
  for (std::size_t block = 0; block < analysis.blocks.size(); ++block) {
    constexpr double kTooMany = 0.05;
    if (largest.at_grid_end[block] <= kTooMany) continue;
    doubts.push_back(
        analysis.blocks[block].name + ": of " + percent_words(largest.at_grid_end[block]) +
        " of the participants the posterior of QUEST+ reaches an end of a grid, so "
        "that the study file decides about their values and they have no interval: "
        "widen the grids, or plan more trials.");
  }
  return doubts;
}

}  // namespace jnd::analysis
