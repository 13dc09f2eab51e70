#include "analysis/results/threshold_group.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

using Scale = std::function<double(double)>;

Summary summary_in(const OwnNumbers& values, const Scale& to) {
  std::vector<double> scaled;
  for (const auto& [participant, value] : values) scaled.push_back(to(value));
  return summary_of(scaled);
}

/// The mean and interval, computed on a scale and transformed back by `from`.
Estimate mean_estimate(const GroupName& group, const Summary& summary, const Scale& from) {
  const auto back = [&](const std::optional<double>& value) {
    return value ? std::optional(from(*value)) : std::nullopt;
  };
  return {.name = group.name + group.suffix,
          .value = back(summary.mean),
          .ci95 = {back(summary.mean_ci95.low), back(summary.mean_ci95.high)},
          .unit = group.unit,
          .meaning = group.meaning + group.words,
          .n = summary.num_values};
}

void add_spread(ResultsSection& section, const GroupName& group, const Summary& summary,
                const std::string& name, const std::string& meaning) {
  section.estimates.push_back({.name = name + group.suffix,
                               .value = summary.standard_deviation,
                               .unit = "1",
                               .meaning = meaning + group.words,
                               .n = summary.num_values});
}

}  // namespace

void add_geometric_mean(ResultsSection& section, const GroupName& group,
                        const OwnNumbers& values) {
  if (values.empty()) return;
  const Summary summary = summary_in(values, [](double value) { return std::log(value); });
  section.estimates.push_back(
      mean_estimate(group, summary, [](double log) { return std::exp(log); }));
  add_spread(section, group, summary, group.name + "_sd_ln",
             said("standard deviation of its ln between people"));
}

void add_median_fraction(ResultsSection& section, const std::string& block,
                         const GroupName& group, const OwnNumbers& fractions) {
  if (fractions.empty()) return;
  const Summary summary =
      summary_in(fractions, [](double value) { return std::log(std::log1p(value)); });
  section.estimates.push_back(
      mean_estimate(group, summary, [](double value) { return std::expm1(std::exp(value)); }));
  add_spread(section, group, summary, block + ".slope_sd_between_people",
             said("sd of ln ln(1 + w) between people: of the participants' own w"));
}

void add_mean(ResultsSection& section, const GroupName& group, const OwnNumbers& values) {
  if (values.empty()) return;
  const auto same = [](double value) { return value; };
  section.estimates.push_back(mean_estimate(group, summary_in(values, same), same));
}

void add_mean_rate(ResultsSection& section, const GroupName& group, const OwnNumbers& rates) {
  if (rates.empty()) return;
  add_mean(section, group, rates);
  Interval& ci95 = section.estimates.back().ci95;
  if (ci95.low) ci95.low = std::max(*ci95.low, 0.0);
  if (ci95.high) ci95.high = std::min(*ci95.high, 1.0);
}

}  // namespace jnd::analysis
