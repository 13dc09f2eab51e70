#include "analysis/statistics/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/statistics/comparison_parts.h"
#include "analysis/statistics/distributions.h"
#include "analysis/statistics/effect_size.h"
#include "analysis/statistics/signed_rank.h"
#include "analysis/statistics/summary.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

void require_pairs(const std::vector<double>& a, const std::vector<double>& b) {
  require_finite(a, "a");
  require_finite(b, "b");
  core::require(a.size() == b.size(), "b", "as many values as a, " + std::to_string(a.size()),
                static_cast<double>(b.size()));
}

/// The exponent of the power of two that scales values up to `largest` to about 1. Dividing by
/// it is exact, and keeps squares within the range of numbers.
int exponent_of(double largest) { return largest > 0.0 ? std::ilogb(largest) : 0; }

std::vector<double> shrunk(const std::vector<double>& values, int exponent) {
  std::vector<double> result;
  for (const double value : values) result.push_back(std::ldexp(value, -exponent));
  return result;
}

std::vector<double> shrunk_differences(const std::vector<double>& a,
                                       const std::vector<double>& b, int exponent) {
  std::vector<double> result = shrunk(a, exponent);
  for (std::size_t pair = 0; pair < a.size(); ++pair) {
    result[pair] -= std::ldexp(b[pair], -exponent);
  }
  return result;
}

/// Scales a value back to its own unit. It is absent if it leaves the range of numbers.
std::optional<double> grown(const std::optional<double>& value, int exponent) {
  const double number = std::ldexp(value.value_or(0.0), exponent);
  return value && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

Interval grown(const Interval& interval, int exponent) {
  return {.low = grown(interval.low, exponent), .high = grown(interval.high, exponent)};
}

/// The standard deviation that rounding may cause among equal values as large as `largest`.
double rounding_of(double largest) {
  return 8.0 * std::numeric_limits<double>::epsilon() * largest;
}

double largest_magnitude(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (const double value : a) largest = std::max(largest, std::fabs(value));
  for (const double value : b) largest = std::max(largest, std::fabs(value));
  return largest;
}

/// Fills in t, p and the interval of an estimate with a known standard error.
void fill_t(Comparison& result, double standard_error, double degrees_of_freedom) {
  const double reach = student_t_quantile(0.975, degrees_of_freedom) * standard_error;
  result.statistic = *result.estimate / standard_error;
  result.degrees_of_freedom = degrees_of_freedom;
  result.p_value = 2.0 * student_t_above(std::fabs(*result.statistic), degrees_of_freedom);
  result.ci95 = {*result.estimate - reach, *result.estimate + reach};
  result.status = FitStatus::kOk;
}

/// Student's t test of differences whose unit is 2^exponent. It fills in only the mean if
/// `result` already has a reason. `largest` is the largest magnitude of the values from which
/// the differences were made.
void test_differences(Comparison& result, const std::vector<double>& differences, int exponent,
                      double largest, EffectSizes effects = EffectSizes::kComputed) {
  const Summary summary = summary_of(differences);
  result.estimate = grown(summary.mean, exponent);
  if (!result.reason.empty()) return;
  const double deviation = *summary.standard_deviation;
  if (!(deviation > rounding_of(std::ldexp(largest, -exponent)))) {
    result.reason = result.kind == Comparison::Kind::kOneSample
                        ? "all values are alike: t is undefined"
                        : "all differences are alike: t is undefined";
    return;
  }
  const double n = static_cast<double>(differences.size());
  result.estimate = summary.mean;
  fill_t(result, deviation / std::sqrt(n), n - 1.0);
  if (effects == EffectSizes::kComputed) {
    add_effect_of_differences(result, *summary.mean / deviation, summary.num_values);
  }
  result.estimate = grown(result.estimate, exponent);
  result.ci95 = grown(result.ci95, exponent);
}

double rank_biserial_of(const SignedRanks& ranks) {
  const double n = ranks.num_nonzero;
  return (ranks.positive_sum - ranks.negative_sum) / (0.5 * n * (n + 1.0));
}

void fill_welch(Comparison& result, const PublishedGroup& a, const PublishedGroup& b) {
  const double part_a = a.standard_deviation * a.standard_deviation / a.num_values;
  const double part_b = b.standard_deviation * b.standard_deviation / b.num_values;
  const double sum = part_a + part_b;
  fill_t(result, std::sqrt(sum),
         sum * sum /
             (part_a * part_a / (a.num_values - 1) + part_b * part_b / (b.num_values - 1)));
}

}  // namespace

void require_finite(const std::vector<double>& values, const char* name) {
  for (const double value : values) {
    core::require(std::isfinite(value), name, "a finite number", value);
  }
}

Comparison started(Comparison::Kind kind, const char* method, std::size_t num_a,
                   std::size_t num_b) {
  Comparison result;
  result.kind = kind;
  result.status = FitStatus::kDegenerate;
  result.method = method;
  result.num_a = static_cast<int>(num_a);
  result.num_b = static_cast<int>(num_b);
  return result;
}

std::vector<std::pair<std::string, double>> Comparison::all_statistics() const {
  std::vector<std::pair<std::string, double>> all = other_statistics;
  if (statistic) all.emplace_back(statistic_name, *statistic);
  return all;
}

Comparison paired_t_test(const std::vector<double>& a, const std::vector<double>& b,
                         EffectSizes effects) {
  require_pairs(a, b);
  Comparison result = started(Comparison::Kind::kPaired, "paired t", a.size(), b.size());
  const double largest = largest_magnitude(a, b);
  const int exponent = exponent_of(largest);
  if (a.size() < 2) result.reason = "too few pairs: a t test needs two";
  test_differences(result, shrunk_differences(a, b, exponent), exponent, largest, effects);
  return result;
}

Comparison one_sample_t_test(const std::vector<double>& values) {
  require_finite(values, "values");
  Comparison result =
      started(Comparison::Kind::kOneSample, "one-sample t against 0", values.size(), 0);
  const double largest = largest_magnitude(values, {});
  const int exponent = exponent_of(largest);
  if (values.size() < 2) result.reason = "too few values: a t test needs two";
  test_differences(result, shrunk(values, exponent), exponent, largest);
  return result;
}

Comparison welch_t_test(const std::vector<double>& a, const std::vector<double>& b,
                        EffectSizes effects) {
  require_finite(a, "a");
  require_finite(b, "b");
  Comparison result = started(Comparison::Kind::kWelch, "Welch's t", a.size(), b.size());
  const double largest = largest_magnitude(a, b);
  const int exponent = exponent_of(largest);
  const Summary of_a = summary_of(shrunk(a, exponent)), of_b = summary_of(shrunk(b, exponent));
  std::optional<double> difference;
  if (of_a.mean && of_b.mean) difference = *of_a.mean - *of_b.mean;
  result.estimate = grown(difference, exponent);
  if (a.size() < 2 || b.size() < 2) {
    result.reason = "too few values: Welch's t needs two in each group";
    return result;
  }
  const double spread = std::max(*of_a.standard_deviation, *of_b.standard_deviation);
  if (!(spread > rounding_of(std::ldexp(largest, -exponent)))) {
    result.reason = "all values of each group are alike: t is undefined";
    return result;
  }
  result.estimate = difference;
  const PublishedGroup group_a{*of_a.mean, *of_a.standard_deviation, result.num_a};
  const PublishedGroup group_b{*of_b.mean, *of_b.standard_deviation, result.num_b};
  fill_welch(result, group_a, group_b);
  if (effects == EffectSizes::kComputed) add_effect_of_groups(result, group_a, group_b);
  result.estimate = grown(result.estimate, exponent);
  result.ci95 = grown(result.ci95, exponent);
  return result;
}

Comparison pooled_t_test(const PublishedGroup& a, const PublishedGroup& b) {
  for (const PublishedGroup& group : {a, b}) {
    core::require(std::isfinite(group.mean), "mean", "a finite number", group.mean);
    core::require(group.standard_deviation >= 0.0, "standard_deviation", "a number >= 0",
                  group.standard_deviation);
    core::require(group.num_values >= 2, "num_values", "a number >= 2", group.num_values);
  }
  Comparison result = started(Comparison::Kind::kPooled, "Student's t, pooled variance", 0, 0);
  result.num_a = a.num_values;
  result.num_b = b.num_values;
  result.estimate = a.mean - b.mean;
  const double degrees_of_freedom = a.num_values + b.num_values - 2;
  const double variance = ((a.num_values - 1) * a.standard_deviation * a.standard_deviation +
                           (b.num_values - 1) * b.standard_deviation * b.standard_deviation) /
                          degrees_of_freedom;
  if (!(variance > 0.0)) {
    result.reason = "both standard deviations are 0: t is undefined";
    return result;
  }
  fill_t(result, std::sqrt(variance * (1.0 / a.num_values + 1.0 / b.num_values)),
         degrees_of_freedom);
  add_effect_of_groups(result, a, b);
  return result;
}

Comparison pearson_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  require_pairs(a, b);
  Comparison result = started(Comparison::Kind::kPearson, "Pearson's r, interval by Fisher's z",
                              a.size(), b.size());
  if (a.size() < 3) {
    result.reason = "too few pairs: a correlation needs three";
    return result;
  }
  // Each column gets its own unit, which does not change r.
  const std::vector<double> own_a = shrunk(a, exponent_of(largest_magnitude(a, {})));
  const std::vector<double> own_b = shrunk(b, exponent_of(largest_magnitude(b, {})));
  const Summary of_a = summary_of(own_a), of_b = summary_of(own_b);
  if (!(*of_a.standard_deviation > rounding_of(largest_magnitude(own_a, {}))) ||
      !(*of_b.standard_deviation > rounding_of(largest_magnitude(own_b, {})))) {
    result.reason = "a column is constant: the correlation is undefined";
    return result;
  }
  // 1 - r and 1 + r come from the standardised columns, so nothing cancels however close r is
  // to 1.
  const double n = static_cast<double>(a.size());
  double difference = 0.0, sum = 0.0, product = 0.0;
  for (std::size_t pair = 0; pair < a.size(); ++pair) {
    const double x = (own_a[pair] - *of_a.mean) / *of_a.standard_deviation;
    const double y = (own_b[pair] - *of_b.mean) / *of_b.standard_deviation;
    product += x * y;
    difference += (x - y) * (x - y);
    sum += (x + y) * (x + y);
  }
  const double r = std::clamp(product / (n - 1.0), -1.0, 1.0);
  const double one_minus_r = 0.5 * difference / (n - 1.0), one_plus_r = 0.5 * sum / (n - 1.0);
  result.estimate = r;
  if (!(std::min(one_minus_r, one_plus_r) > 1e-28)) {
    result.estimate = r > 0.0 ? 1.0 : -1.0;
    result.reason = "the columns lie on a line: t is infinite";
    return result;
  }
  const double degrees_of_freedom = n - 2.0;
  result.degrees_of_freedom = degrees_of_freedom;
  result.statistic = r * std::sqrt(degrees_of_freedom / (one_minus_r * one_plus_r));
  result.p_value = 2.0 * student_t_above(std::fabs(*result.statistic), degrees_of_freedom);
  if (a.size() > 3) {
    const double z = 0.5 * std::log(one_plus_r / one_minus_r);
    const double reach = normal_quantile(0.975) / std::sqrt(n - 3.0);
    result.ci95 = {std::tanh(z - reach), std::tanh(z + reach)};
  }
  result.status = FitStatus::kOk;
  return result;
}

Comparison wilcoxon_test(const std::vector<double>& a, const std::vector<double>& b) {
  require_pairs(a, b);
  Comparison result =
      started(Comparison::Kind::kWilcoxon, "Wilcoxon's signed ranks", a.size(), b.size());
  if (a.empty()) {
    result.reason = "no pairs";
    return result;
  }
  const int exponent = exponent_of(largest_magnitude(a, b));
  const std::vector<double> difference = shrunk_differences(a, b, exponent);
  result.estimate = grown(summary_of(difference).mean, exponent);
  // The accuracy of each difference depends on its own pair only.
  std::vector<double> roundings;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double larger = std::max(std::fabs(a[i]), std::fabs(b[i]));
    roundings.push_back(rounding_of(std::ldexp(larger, -exponent)));
  }
  const SignedRanks ranks = signed_ranks(difference, roundings);
  if (ranks.num_nonzero == 0) {
    result.reason = "all differences are 0: there is nothing to rank";
    return result;
  }
  result.statistic = std::min(ranks.positive_sum, ranks.negative_sum);
  result.statistic_name = "T";
  result.other_statistics = {{"V", ranks.positive_sum}};
  result.p_value = ranks.p_value;
  result.num_zeros = ranks.num_zeros;
  result.method += rank_method(ranks.exact, ranks.has_ties);
  if (ranks.num_zeros > 0) {
    result.method += ", without " + std::to_string(ranks.num_zeros) +
                     (ranks.num_zeros == 1 ? " difference of 0" : " differences of 0");
  }
  result.hodges_lehmann = grown(ranks.median, exponent);
  result.hodges_lehmann_ci95 = grown(ranks.median_ci95, exponent);
  result.rank_biserial = rank_biserial_of(ranks);
  result.status = FitStatus::kOk;
  return result;
}

}  // namespace jnd::analysis
