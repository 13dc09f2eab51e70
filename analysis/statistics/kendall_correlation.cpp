#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "analysis/statistics/comparison.h"
#include "analysis/statistics/comparison_parts.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostExactOrders = 50;

/// The counts of all values that occur more than once.
std::vector<double> ties_of(const std::vector<double>& values) {
  std::map<double, double> counts;
  for (const double value : values) counts[value] += 1.0;
  std::vector<double> ties;
  for (const auto& [value, count] : counts) {
    if (count > 1.0) ties.push_back(count);
  }
  return ties;
}

template <typename Term>
double sum_over(const std::vector<double>& ties, const Term& term) {
  double sum = 0.0;
  for (const double count : ties) sum += term(count);
  return sum;
}

/// Twice the smaller tail of the number of concordant pairs, if every order is equally likely.
/// Each added element is concordant with 0 to all of the elements before it, with equal
/// probability (Kendall 1938).
double exact_p(double num_concordant, std::size_t num_values) {
  std::vector<double> shares = {1.0};
  for (std::size_t added = 1; added < num_values; ++added) {
    std::vector<double> next(shares.size() + added, 0.0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      for (std::size_t more = 0; more <= added; ++more) {
        next[i + more] += shares[i] / static_cast<double>(added + 1);
      }
    }
    shares = std::move(next);
  }
  double up_to = 0.0, from = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto count = static_cast<double>(i);
    if (count <= num_concordant) up_to += shares[i];
    if (count >= num_concordant) from += shares[i];
  }
  return std::min(1.0, 2.0 * std::min(up_to, from));
}

/// The variance of concordant minus discordant pairs under independence, corrected for ties
/// (Kendall 1970, equation 4.3).
double variance_with_ties(double n, const std::vector<double>& of_a,
                          const std::vector<double>& of_b) {
  const auto spread = [](double t) { return t * (t - 1.0) * (2.0 * t + 5.0); };
  const auto pairs = [](double t) { return t * (t - 1.0); };
  const auto triples = [](double t) { return t * (t - 1.0) * (t - 2.0); };
  return (spread(n) - sum_over(of_a, spread) - sum_over(of_b, spread)) / 18.0 +
         sum_over(of_a, triples) * sum_over(of_b, triples) / (9.0 * n * (n - 1.0) * (n - 2.0)) +
         sum_over(of_a, pairs) * sum_over(of_b, pairs) / (2.0 * n * (n - 1.0));
}

}  // namespace

Comparison kendall_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  require_finite(a, "a");
  require_finite(b, "b");
  core::require(a.size() == b.size(), "b", "as many values as a, " + std::to_string(a.size()),
                static_cast<double>(b.size()));
  Comparison result =
      started(Comparison::Kind::kKendall, "Kendall's tau b", a.size(), b.size());
  if (a.size() < 3) {
    result.reason = "fewer than three pairs";
    return result;
  }
  double num_concordant = 0.0, num_discordant = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int sign_a = (a[i] > a[j]) - (a[i] < a[j]), sign_b = (b[i] > b[j]) - (b[i] < b[j]);
      num_concordant += sign_a * sign_b > 0 ? 1.0 : 0.0;
      num_discordant += sign_a * sign_b < 0 ? 1.0 : 0.0;
    }
  }
  const auto n = static_cast<double>(a.size());
  const std::vector<double> of_a = ties_of(a), of_b = ties_of(b);
  const auto tied_pairs = [](double t) { return 0.5 * t * (t - 1.0); };
  const double all = 0.5 * n * (n - 1.0);
  const double untied_a = all - sum_over(of_a, tied_pairs);
  const double untied_b = all - sum_over(of_b, tied_pairs);
  if (!(untied_a > 0.0) || !(untied_b > 0.0)) {
    result.reason = "all values of a column are alike: there is nothing to rank";
    return result;
  }
  const double excess = num_concordant - num_discordant;
  result.estimate = excess / std::sqrt(untied_a * untied_b);
  const bool has_ties = !of_a.empty() || !of_b.empty();
  const bool is_exact = !has_ties && a.size() <= kMostExactOrders;
  if (is_exact) {
    result.statistic = num_concordant;
    result.statistic_name = "num_concordant";
    result.p_value = exact_p(num_concordant, a.size());
    result.method += ", exact";
  } else {
    result.statistic = excess / std::sqrt(variance_with_ties(n, of_a, of_b));
    result.statistic_name = "z";
    result.p_value = std::erfc(std::fabs(*result.statistic) / std::sqrt(2.0));
    result.method += has_ties ? ", normal approximation with ties, no continuity correction"
                              : ", normal approximation, no continuity correction";
  }
  result.status = FitStatus::kOk;
  return result;
}

}  // namespace jnd::analysis
