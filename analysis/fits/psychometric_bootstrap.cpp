#include "analysis/fits/psychometric_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/groups/summary.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

/// Draws from a binomial distribution by inverting its cumulative distribution, tabulated where
/// it is not negligible.
class BinomialTable {
 public:
  BinomialTable(double num_trials, double probability) {
    if (probability <= 0.0 || probability >= 1.0) {
      first_ = probability <= 0.0 ? 0.0 : num_trials;
      return;
    }
    const double mean = num_trials * probability;
    const double reach = 12.0 * std::sqrt(mean * (1.0 - probability)) + 40.0;
    first_ = std::max(0.0, std::floor(mean - reach));
    const double last = std::min(num_trials, std::ceil(mean + reach));
    double sum = 0.0;
    for (double count = first_; count <= last; count += 1.0) {
      sum += std::exp(std::lgamma(num_trials + 1.0) - std::lgamma(count + 1.0) -
                      std::lgamma(num_trials - count + 1.0) + count * std::log(probability) +
                      (num_trials - count) * std::log1p(-probability));
      cumulative_.push_back(sum);
    }
    for (double& value : cumulative_) value /= sum;
  }

  [[nodiscard]] double draw(core::RandomStream& random) const noexcept {
    const auto found =
        std::upper_bound(cumulative_.begin(), cumulative_.end(), random.uniform());
    return first_ + static_cast<double>(found - cumulative_.begin());
  }

 private:
  double first_ = 0.0;
  std::vector<double> cumulative_;
};

std::optional<double> end_at(const std::vector<double>& ascending, double probability) {
  const double value = percentile(ascending, probability);
  return std::isfinite(value) && value > 0.0 ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

BootstrapInterval bootstrapped_weber_fraction(const PsychometricSearch& search,
                                              const PsychometricLevels& levels,
                                              const PsychometricCurve& fitted, int num_refits,
                                              std::uint64_t seed) {
  std::vector<BinomialTable> tables;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    tables.emplace_back(levels.num_trials[level], fitted.probability(levels, level));
  }
  const BinomialTable at_zero(levels.zero_trials, fitted.lapse);
  core::RandomStream random(seed, "bootstrap of a psychometric function");
  PsychometricLevels redrawn = levels;
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(num_refits));
  BootstrapInterval result;
  result.n = num_refits;
  for (int refit = 0; refit < num_refits; ++refit) {
    for (std::size_t level = 0; level < levels.size(); ++level) {
      redrawn.num_yes[level] = tables[level].draw(random);
    }
    redrawn.zero_yes = at_zero.draw(random);
    const PsychometricSearchResult found = search.find(redrawn, minimised_by_newton, &fitted);
    if (found.supremum == PsychometricSupremum::kAttained) {
      values.push_back(found.optimum.curve.weber_fraction(levels));
      continue;
    }
    ++result.num_degenerate;
    if (found.supremum == PsychometricSupremum::kStep) values.push_back(0.0);
    if (found.supremum == PsychometricSupremum::kFlat) {
      values.push_back(std::numeric_limits<double>::infinity());
    }
  }
  result.method = "parametric, percentile";
  if (values.empty()) return result;
  std::sort(values.begin(), values.end());
  result.ci95 = {.low = end_at(values, 0.025), .high = end_at(values, 0.975)};
  const double estimate = fitted.weber_fraction(levels);
  if (estimate < result.ci95.low.value_or(0.0) ||
      estimate > result.ci95.high.value_or(std::numeric_limits<double>::infinity())) {
    result.ci95 = {};
    result.method += "; refused, because it would miss the estimate";
  }
  return result;
}

}  // namespace jnd::analysis
