#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>

#include "analysis/statistics/comparison.h"
#include "analysis/statistics/comparison_parts.h"
#include "analysis/statistics/summary.h"
#include "core/random_stream.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr double kMostArrangements = 1 << 20;
constexpr int kNumDrawn = 99999;

/// Counts arrangements whose sum is at least as far from 0 as the observed one, apart from
/// rounding.
class AsFarOut {
 public:
  AsFarOut(double observed, double rounding) : least_(std::fabs(observed) - rounding) {}

  void count(double sum) {
    num_ += std::fabs(sum) >= least_ ? 1.0 : 0.0;
    all_ += 1.0;
  }
  [[nodiscard]] double share() const { return num_ / all_; }
  /// The observed arrangement counts as one of those that could have been drawn.
  [[nodiscard]] double share_of_drawn() const { return (num_ + 1.0) / (all_ + 1.0); }

 private:
  double least_;
  double num_ = 0.0, all_ = 0.0;
};

double rounding_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::fabs(value);
  return 1e-12 * sum;
}

/// Visits every combination of signs. Each step changes one sign (Gray code).
double exact_of_signs(std::vector<double> values) {
  double sum = std::accumulate(values.begin(), values.end(), 0.0);
  AsFarOut far(sum, rounding_of(values));
  far.count(sum);
  const std::uint64_t num_arrangements = std::uint64_t{1} << values.size();
  for (std::uint64_t i = 1; i < num_arrangements; ++i) {
    double& turned = values[static_cast<std::size_t>(std::countr_zero(i))];
    sum -= 2.0 * turned;
    turned = -turned;
    far.count(sum);
  }
  return far.share();
}

double drawn_of_signs(const std::vector<double>& values) {
  AsFarOut far(std::accumulate(values.begin(), values.end(), 0.0), rounding_of(values));
  core::RandomStream random(1, "permutations");
  for (int draw = 0; draw < kNumDrawn; ++draw) {
    double sum = 0.0;
    for (const double value : values) sum += random.uniform() < 0.5 ? value : -value;
    far.count(sum);
  }
  return far.share_of_drawn();
}

double num_ways(std::size_t num_a, std::size_t num) {
  double ways = 1.0;
  for (std::size_t i = 1; i <= num_a; ++i) {
    ways *= static_cast<double>(num - num_a + i) / static_cast<double>(i);
  }
  return ways;
}

/// Visits every choice of the first group's members. `values` have mean 0, so the sum over one
/// group determines the difference of the means.
double exact_of_groups(const std::vector<double>& values, std::size_t num_a) {
  const double observed =
      std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(num_a), 0.0);
  AsFarOut far(observed, rounding_of(values));
  std::vector<bool> is_in_a(values.size(), false);
  std::fill(is_in_a.begin(), is_in_a.begin() + static_cast<std::ptrdiff_t>(num_a), true);
  do {
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += is_in_a[i] ? values[i] : 0.0;
    far.count(sum);
  } while (std::prev_permutation(is_in_a.begin(), is_in_a.end()));
  return far.share();
}

double drawn_of_groups(std::vector<double> values, std::size_t num_a) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(num_a);
  AsFarOut far(std::accumulate(values.begin(), middle, 0.0), rounding_of(values));
  core::RandomStream random(1, "permutations");
  for (int draw = 0; draw < kNumDrawn; ++draw) {
    // After a partial shuffle the first `num_a` values are a random choice.
    for (std::size_t i = 0; i < num_a; ++i) {
      std::swap(values[i],
                values[i + static_cast<std::size_t>(random.below(values.size() - i))]);
    }
    far.count(std::accumulate(values.begin(), middle, 0.0));
  }
  return far.share_of_drawn();
}

std::string drawn_words() { return ", " + std::to_string(kNumDrawn) + " arrangements drawn"; }

/// Turns a t test into a permutation test. It keeps the estimate and effect sizes and removes
/// what depends on the distribution, which that of the arrangements replaces.
Comparison of_arrangements(Comparison result, Comparison::Kind kind, const char* method) {
  result.kind = kind;
  result.method = method;
  result.ci95 = {};
  result.degrees_of_freedom.reset();
  result.p_value.reset();
  result.statistic = result.status == FitStatus::kOk ? result.estimate : std::nullopt;
  result.statistic_name = "mean_difference";
  return result;
}

/// Where all values are alike t is undefined, but the arrangements are not: it is the clearest
/// difference that there is. False where there are too few.
bool is_possible(Comparison& result, double mean_difference, std::size_t fewest) {
  if (result.status == FitStatus::kOk) return true;
  if (fewest < 2 || !std::isfinite(mean_difference)) return false;
  result.status = FitStatus::kOk;
  result.reason.clear();
  result.estimate = result.statistic = mean_difference;
  return true;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(values.size());
}

}  // namespace

Comparison permutation_test(const std::vector<double>& a, const std::vector<double>& b) {
  Comparison result =
      of_arrangements(paired_t_test(a, b), Comparison::Kind::kPermutation,
                      "permutation test of the mean of the differences, all signs");
  std::vector<double> differences;
  for (std::size_t pair = 0; pair < a.size(); ++pair) differences.push_back(a[pair] - b[pair]);
  if (!is_possible(result, mean_of(differences), a.size())) return result;
  const bool is_exact = std::exp2(static_cast<double>(a.size())) <= kMostArrangements;
  result.p_value = is_exact ? exact_of_signs(differences) : drawn_of_signs(differences);
  if (!is_exact) result.method += drawn_words();
  return result;
}

Comparison group_permutation_test(const std::vector<double>& a, const std::vector<double>& b) {
  Comparison result =
      of_arrangements(welch_t_test(a, b), Comparison::Kind::kGroupPermutation,
                      "permutation test of the difference of the means, all groupings");
  if (!is_possible(result, mean_of(a) - mean_of(b), std::min(a.size(), b.size()))) {
    return result;
  }
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  const double mean = mean_of(all);
  for (double& value : all) value -= mean;
  const bool is_exact = num_ways(a.size(), all.size()) <= kMostArrangements;
  result.p_value = is_exact ? exact_of_groups(all, a.size()) : drawn_of_groups(all, a.size());
  if (!is_exact) result.method += drawn_words();
  return result;
}

}  // namespace jnd::analysis
