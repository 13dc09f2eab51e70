#include "analysis/fits/psychometric_redraw.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {

BinomialTable::BinomialTable(double num_trials, double probability) {
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

double BinomialTable::draw(core::RandomStream& random) const noexcept {
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), random.uniform());
  return first_ + static_cast<double>(found - cumulative_.begin());
}

AnswerRedraw::AnswerRedraw(const PsychometricLevels& levels, const PsychometricCurve& curve) {
  for (std::size_t level = 0; level < levels.size(); ++level) {
    tables_.emplace_back(levels.num_trials[level], curve.probability(levels, level));
  }
  tables_.emplace_back(levels.zero_trials, levels.ends.low(curve.lapse, curve.guess));
}

AnswerRedraw::AnswerRedraw(const PsychometricLevels& levels) {
  for (std::size_t level = 0; level < levels.size(); ++level) {
    tables_.emplace_back(levels.num_trials[level], levels.proportion(level));
  }
  const double at_zero = levels.zero_trials > 0.0 ? levels.zero_yes / levels.zero_trials : 0.0;
  tables_.emplace_back(levels.zero_trials, at_zero);
}

void AnswerRedraw::draw(core::RandomStream& random, PsychometricLevels& levels) const noexcept {
  for (std::size_t level = 0; level < levels.size(); ++level) {
    levels.num_yes[level] = tables_[level].draw(random);
  }
  levels.zero_yes = tables_.back().draw(random);
}

AnswerNumbering::AnswerNumbering(const std::vector<double>& num_trials) {
  constexpr double kMostSets = 0x1p62;
  double num_sets = 1.0;
  for (const double num : num_trials) {
    if (!(num_sets <= kMostSets)) break;
    places_.push_back(static_cast<std::uint64_t>(num_sets));
    num_sets *= num + 1.0;
  }
  has_numbers_ = num_sets <= kMostSets;
}

std::optional<std::uint64_t> AnswerNumbering::of(
    const std::vector<double>& num_yes) const noexcept {
  if (!has_numbers_) return std::nullopt;
  std::uint64_t number = 0;
  for (std::size_t level = 0; level < num_yes.size(); ++level) {
    number += places_[level] * static_cast<std::uint64_t>(num_yes[level]);
  }
  return number;
}

}  // namespace jnd::analysis
