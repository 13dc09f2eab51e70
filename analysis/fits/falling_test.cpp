#include "analysis/fits/falling_test.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace {

/// Trials and "yes" at each rank of the intensities, for one order of the intervals.
struct Stratum {
  std::map<std::size_t, std::int64_t> num_trials;
  std::int64_t num_all = 0, num_yes = 0;
  std::size_t sum_of_ranks = 0;  ///< The sum of ranks over all "yes".
};

std::vector<Stratum> strata_of(const std::vector<AnswerCount>& rows) {
  std::map<double, std::size_t> ranks;
  for (const AnswerCount& row : rows) {
    if (row.num_trials > 0) ranks.emplace(row.intensity, 0);
  }
  std::size_t rank = 0;
  for (auto& [intensity, its_rank] : ranks) its_rank = rank++;
  std::map<double, Stratum> by_order;
  for (const AnswerCount& row : rows) {
    if (row.num_trials == 0) continue;
    Stratum& stratum = by_order[row.order];
    const std::size_t its_rank = ranks[row.intensity];
    stratum.num_trials[its_rank] += row.num_trials;
    stratum.num_all += row.num_trials;
    stratum.num_yes += row.num_yes;
    stratum.sum_of_ranks += its_rank * static_cast<std::size_t>(row.num_yes);
  }
  std::vector<Stratum> strata;
  for (auto& [order, stratum] : by_order) strata.push_back(std::move(stratum));
  return strata;
}

/// The binomial coefficients n over 0, 1, ..., n. With n <= 200 they stay in the range of
/// double.
std::vector<double> choices(std::int64_t n) {
  std::vector<double> row = {1.0};
  for (std::int64_t k = 1; k <= n; ++k) {
    row.push_back(row.back() * static_cast<double>(n - k + 1) / static_cast<double>(k));
  }
  return row;
}

/// The probability of each sum of ranks, given the number of "yes".
std::vector<double> exact_distribution(const Stratum& stratum) {
  const auto num_yes = static_cast<std::size_t>(stratum.num_yes);
  const std::size_t largest = num_yes * stratum.num_trials.rbegin()->first;
  // Indexed by the number of "yes" placed so far, and by their sum of ranks.
  std::vector<std::vector<double>> ways(num_yes + 1, std::vector<double>(largest + 1, 0.0));
  ways[0][0] = 1.0;
  for (const auto& [rank, num_trials] : stratum.num_trials) {
    const std::vector<double> choose = choices(num_trials);
    for (std::size_t placed = num_yes + 1; placed-- > 0;) {
      for (std::size_t here = 1; here < choose.size() && placed + here <= num_yes; ++here) {
        for (std::size_t sum = 0; sum + here * rank <= largest; ++sum) {
          ways[placed + here][sum + here * rank] += ways[placed][sum] * choose[here];
        }
      }
    }
  }
  const double all = choices(stratum.num_all)[num_yes];
  for (double& way : ways[num_yes]) way /= all;
  return ways[num_yes];
}

double exact_p_value(const std::vector<Stratum>& strata) {
  std::vector<double> sums = {1.0};
  std::size_t observed = 0;
  for (const Stratum& stratum : strata) {
    const std::vector<double> own = exact_distribution(stratum);
    std::vector<double> both(sums.size() + own.size() - 1, 0.0);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      for (std::size_t j = 0; j < own.size(); ++j) both[i + j] += sums[i] * own[j];
    }
    sums = std::move(both);
    observed += stratum.sum_of_ranks;
  }
  double p_value = 0.0;
  for (std::size_t sum = 0; sum <= observed && sum < sums.size(); ++sum) p_value += sums[sum];
  return std::min(p_value, 1.0);
}

/// The p value from the moments of the hypergeometric distribution, with a correction for
/// continuity.
std::optional<double> normal_p_value(const std::vector<Stratum>& strata) {
  double excess = 0.0, variance = 0.0;
  for (const Stratum& stratum : strata) {
    const auto n = static_cast<double>(stratum.num_all);
    const auto yes = static_cast<double>(stratum.num_yes);
    double mean = 0.0, squares = 0.0;
    for (const auto& [rank, num_trials] : stratum.num_trials) {
      const auto score = static_cast<double>(rank);
      mean += score * static_cast<double>(num_trials) / n;
      squares += score * score * static_cast<double>(num_trials);
    }
    squares -= n * mean * mean;
    excess += static_cast<double>(stratum.sum_of_ranks) - yes * mean;
    if (n > 1.0) variance += yes * (n - yes) / n * squares / (n - 1.0);
  }
  if (!(variance > 0.0)) return std::nullopt;
  return core::standard_normal_cdf((excess + 0.5) / std::sqrt(variance));
}

bool can_fall(const Stratum& stratum) {
  return stratum.num_trials.size() > 1 && stratum.num_yes > 0 &&
         stratum.num_yes < stratum.num_all;
}

}  // namespace

std::optional<double> falling_p_value(const std::vector<AnswerCount>& rows) {
  constexpr std::int64_t kMostExact = 200;
  std::vector<Stratum> strata = strata_of(rows);
  std::erase_if(strata, [](const Stratum& one) { return !can_fall(one); });
  if (strata.empty()) return std::nullopt;
  std::int64_t num_trials = 0;
  for (const Stratum& stratum : strata) num_trials += stratum.num_all;
  if (num_trials > kMostExact) return normal_p_value(strata);
  return exact_p_value(strata);
}

std::optional<double> significant_fall(const std::vector<AnswerCount>& rows) {
  const std::optional<double> p_value = falling_p_value(rows);
  return p_value && *p_value < kFallingBelow ? p_value : std::nullopt;
}

std::string falling_p_words(double p_value) {
  char words[32] = "p < 0.001";
  if (p_value >= 0.001) std::snprintf(words, sizeof words, "p = %.3f", p_value);
  return words;
}

std::string falling_words(double p_value) {
  return "the answers fall as the intensity grows (exact trend test, " +
         falling_p_words(p_value) + "), as of somebody who answers the wrong way round";
}

std::string falling_warning(double p_value) {
  return falling_words(p_value) +
         ": no curve that rises is theirs; see whether num_yes counts the other answer";
}

}  // namespace jnd::analysis
