#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/fits/psychometric_model.h"
#include "core/random_stream.h"

namespace jnd::analysis {

/// Draws from a binomial distribution by inverting its cumulative distribution, which is
/// tabulated where it is not negligible.
class BinomialTable {
 public:
  /// `num_trials` >= 0, `probability` in [0, 1].
  BinomialTable(double num_trials, double probability);
  [[nodiscard]] double draw(core::RandomStream& random) const noexcept;

 private:
  double first_ = 0.0;
  std::vector<double> cumulative_;
};

/// Redraws the answers at each level. The numbers of trials stay the same.
class AnswerRedraw {
 public:
  /// Redraws from a curve, as the parametric bootstrap and the goodness of fit do.
  AnswerRedraw(const PsychometricLevels& levels, const PsychometricCurve& curve);
  /// Redraws from the answers themselves, with replacement. This is the nonparametric
  /// bootstrap, stratified by level.
  explicit AnswerRedraw(const PsychometricLevels& levels);

  /// Replaces the answers of `levels`, which must be the levels of the constructor.
  void draw(core::RandomStream& random, PsychometricLevels& levels) const noexcept;

 private:
  std::vector<BinomialTable> tables_;  ///< One table for each level, then one for intensity 0.
};

/// Gives each possible set of answers a unique number. Few answers are often redrawn alike, and
/// their result is then known already.
class AnswerNumbering {
 public:
  explicit AnswerNumbering(const std::vector<double>& num_trials);

  /// The number is absent if there are more sets than numbers. Such sets are hardly ever drawn
  /// twice.
  [[nodiscard]] std::optional<std::uint64_t> of(
      const std::vector<double>& num_yes) const noexcept;

 private:
  std::vector<std::uint64_t> places_;  ///< How much a yes at each level adds to the number.
  bool has_numbers_ = true;
};

}  // namespace jnd::analysis
