#pragma once

#include <optional>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// An effect, how surely it is known, and against how many degrees of freedom: everything that
/// Student's tests and intervals need. On the scale on which it is tested, which for a ratio is
/// its logarithm.
struct EffectEstimate {
  double effect = 0.0;
  double standard_error = 0.0;      ///< > 0
  double degrees_of_freedom = 0.0;  ///< > 0

  [[nodiscard]] double statistic() const noexcept { return effect / standard_error; }
};

/// Which effects count against the null hypothesis.
enum class Tail { kTwoSided, kGreater, kLess };

/// Of the null hypothesis that there is no effect, or none on the side of the tail.
[[nodiscard]] double p_value_of(const EffectEstimate& estimate, Tail tail);

/// The interval that holds the effect with this confidence, 0 < confidence < 1.
[[nodiscard]] Interval interval_of(const EffectEstimate& estimate, double confidence);

/// Two one-sided tests of whether the effect lies within (-margin, margin) (Schuirmann 1987):
/// the larger of both p values. It is below alpha where the interval with the confidence
/// 1 - 2 alpha lies within the margin. `margin` > 0.
[[nodiscard]] double equivalence_p_value(const EffectEstimate& estimate, double margin);

/// What people's weighted sums come to: the sum over groups of the mean of each, its variance
/// the sum of each mean's, and degrees of freedom by Welch (1947) and Satterthwaite (1946); of
/// one group Student's, with n - 1. Absent where a group has fewer than two people, or nobody
/// differs from anybody of the same group.
[[nodiscard]] std::optional<EffectEstimate> contrast_estimate(
    const std::vector<std::vector<double>>& scores_by_group);

/// p values adjusted by Bonferroni: each times how many there are, at most 1; what is absent
/// stays absent and is not counted.
[[nodiscard]] std::vector<std::optional<double>> bonferroni_adjusted(
    const std::vector<std::optional<double>>& p_values);

}  // namespace jnd::analysis
