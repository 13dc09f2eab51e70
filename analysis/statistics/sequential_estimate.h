#pragma once

#include <optional>
#include <utility>

#include "analysis/statistics/sequential_test.h"

namespace jnd::analysis {

/// What a study that ended by its rule says of the effect, in the stage-wise order of outcomes
/// (Armitage 1957; Tsiatis, Rosner and Mehta 1984): the earlier it crossed a boundary, the more
/// extreme, and at one look the larger t. The ordinary estimate of a study that stopped early
/// is too large, and its interval too short.
///
/// The last look's t has its own distribution. Whether earlier looks would have ended the study
/// is worked out for the effect in question over its standard error, which is that of the last
/// look; boundaries of t become boundaries of Z by the noncentral t distribution.
class SequentialEstimate {
 public:
  /// Nothing where the last look has no estimate or the study has not ended.
  [[nodiscard]] static std::optional<SequentialEstimate> of(
      const SequentialBoundaries& boundaries, const SequentialOutcome& outcome);

  /// The probability of an outcome at least as far up or down as the one there is, if this were
  /// the effect. They add up to 1. Not real time.
  [[nodiscard]] double probability_above(double effect) const;
  [[nodiscard]] double probability_below(double effect) const;

  /// Of no effect, on the side that was planned. Below alpha just where the study ended with a
  /// crossed boundary.
  [[nodiscard]] double p_value() const;
  /// That which the outcome is as likely above as below; none where no effect is so.
  [[nodiscard]] std::optional<double> median_unbiased() const;
  /// The interval that holds the effect with this confidence, 0 < confidence < 1. Two-sided.
  [[nodiscard]] Interval interval(double confidence) const;

 private:
  SequentialEstimate(SequentialBoundaries boundaries, SequentialOutcome outcome)
      : boundaries_(std::move(boundaries)), outcome_(std::move(outcome)) {}

  /// The effect at which `probability_above` comes to this.
  [[nodiscard]] std::optional<double> effect_at(double probability) const;

  SequentialBoundaries boundaries_;
  SequentialOutcome outcome_;
};

}  // namespace jnd::analysis
