#pragma once

#include <optional>
#include <utility>

#include "analysis/statistics/sequential_test.h"

namespace jnd::analysis {

/// The estimate of the effect in a study that ended by its sequential rule. It uses the
/// stage-wise order of outcomes (Armitage 1957; Tsiatis, Rosner and Mehta 1984): an outcome is
/// more extreme if the study crossed a boundary at an earlier look or, at the same look, with a
/// larger t. The ordinary estimate of a study that stopped early is too large, and its interval
/// too short.
///
/// The t of the last look has its exact distribution. Whether earlier looks would have ended
/// the study is computed for the assumed effect divided by the standard error of the last look.
/// Boundaries of t are converted to boundaries of Z by the noncentral t distribution.
class SequentialEstimate {
 public:
  /// Absent if the last look has no estimate or the study has not ended.
  [[nodiscard]] static std::optional<SequentialEstimate> of(
      const SequentialBoundaries& boundaries, const SequentialOutcome& outcome);

  /// The probabilities of an outcome at least as high and at least as low as the observed one,
  /// if `effect` were true. They add up to 1. Not real time.
  [[nodiscard]] double probability_above(double effect) const;
  [[nodiscard]] double probability_below(double effect) const;

  /// The p value of no effect against the planned side. It is below alpha exactly if the study
  /// ended with a crossed boundary.
  [[nodiscard]] double p_value() const;
  /// The effect under which the outcome is as likely to be above as below. It is absent if
  /// there is no such effect.
  [[nodiscard]] std::optional<double> median_unbiased() const;
  /// The two-sided interval with this confidence, 0 < confidence < 1.
  [[nodiscard]] Interval interval(double confidence) const;

 private:
  SequentialEstimate(SequentialBoundaries boundaries, SequentialOutcome outcome)
      : boundaries_(std::move(boundaries)), outcome_(std::move(outcome)) {}

  /// The effect at which `probability_above` equals this probability.
  [[nodiscard]] std::optional<double> effect_at(double probability) const;

  SequentialBoundaries boundaries_;
  SequentialOutcome outcome_;
};

}  // namespace jnd::analysis
