#include "analysis/statistics/equivalence_test.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/effect_test.h"
#include "core/error.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

bool any_not_positive(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return !(value > 0.0); });
}

std::vector<double> logarithms_of(const std::vector<double>& values) {
  std::vector<double> logarithms;
  for (const double value : values) logarithms.push_back(std::log(value));
  return logarithms;
}

/// The estimate of a - b.
std::optional<EffectEstimate> difference_of(const std::vector<double>& a,
                                            const std::vector<double>& b, bool is_paired) {
  if (!is_paired) {
    std::vector<double> turned = b;
    for (double& value : turned) value = -value;
    return contrast_estimate({a, turned});
  }
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(a[i] - b[i]);
  return contrast_estimate({differences});
}

}  // namespace

EquivalenceTest equivalence_test(const std::vector<double>& a, const std::vector<double>& b,
                                 bool is_paired, const EquivalenceMargin& margin) {
  const bool is_ratio = margin.scale == EquivalenceMargin::Scale::kRatio;
  core::require(std::isfinite(margin.size) && margin.size > (is_ratio ? 1.0 : 0.0), "margin",
                is_ratio ? "a number > 1" : "a number > 0", margin.size);
  if (!all_finite(a) || !all_finite(b)) {
    throw core::Error("equivalence: expected finite values, found one that is not");
  }
  if (is_paired && a.size() != b.size()) {
    throw core::Error("equivalence: expected as many values of a as of b, found " +
                      std::to_string(a.size()) + " and " + std::to_string(b.size()));
  }
  EquivalenceTest test{.margin = margin};
  const auto refused = [&](const char* reason) {
    test.status = FitStatus::kDegenerate;
    test.reason = reason;
    return test;
  };
  if (is_ratio && (any_not_positive(a) || any_not_positive(b))) {
    return refused("a value is 0 or less, which has no ratio");
  }
  const auto estimate = is_ratio ? difference_of(logarithms_of(a), logarithms_of(b), is_paired)
                                 : difference_of(a, b, is_paired);
  if (!estimate) {
    return refused(is_paired
                       ? "fewer than two pairs, or all differ by the same"
                       : "fewer than two values in a group, or none differs from another");
  }
  const auto shown = [&](double value) { return is_ratio ? std::exp(value) : value; };
  const Interval interval = interval_of(*estimate, 0.9);
  test.status = FitStatus::kOk;
  test.estimate = shown(estimate->effect);
  test.ci90 = {shown(interval.low.value()), shown(interval.high.value())};
  test.degrees_of_freedom = estimate->degrees_of_freedom;
  test.p_value = equivalence_p_value(*estimate, is_ratio ? std::log(margin.size) : margin.size);
  return test;
}

}  // namespace jnd::analysis
