#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/fits/psychometric_model.h"
#include "core/random_stream.h"

namespace jnd::analysis {

/// Draws from a binomial distribution by inverting its cumulative distribution, tabulated where
/// it is not negligible.
class BinomialTable {
 public:
  /// `num_trials` >= 0, `probability` in [0, 1].
  BinomialTable(double num_trials, double probability);
  [[nodiscard]] double draw(core::RandomStream& random) const noexcept;

 private:
  double first_ = 0.0;
  std::vector<double> cumulative_;
};

/// Draws the answers at each level anew, each level with as many trials as it has.
class AnswerRedraw {
 public:
  /// From a curve, as the parametric bootstrap and the goodness of fit do.
  AnswerRedraw(const PsychometricLevels& levels, const PsychometricCurve& curve);
  /// From the answers themselves, with replacement: the nonparametric bootstrap, stratified by
  /// level.
  explicit AnswerRedraw(const PsychometricLevels& levels);

  /// Replaces the answers of `levels`, which are those of the constructor.
  void draw(core::RandomStream& random, PsychometricLevels& levels) const noexcept;

 private:
  std::vector<BinomialTable> tables_;  ///< One a level, then that of intensity 0.
};

/// Gives every set of answers that can be drawn a number of its own: few answers are often
/// drawn alike, and what was found of them is then known.
class AnswerNumbering {
 public:
  explicit AnswerNumbering(const std::vector<double>& num_trials);

  /// Absent where there are more sets than numbers: those are never drawn twice.
  [[nodiscard]] std::optional<std::uint64_t> of(
      const std::vector<double>& num_yes) const noexcept;

 private:
  std::vector<std::uint64_t> places_;  ///< What a yes at each level counts.
  bool has_numbers_ = true;
};

}  // namespace jnd::analysis
