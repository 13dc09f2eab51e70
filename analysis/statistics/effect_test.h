#pragma once

#include <optional>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// An effect with its standard error and degrees of freedom, which is all that Student's tests
/// and intervals need. It is on the scale on which it is tested; for a ratio that is its
/// logarithm.
struct EffectEstimate {
  double effect = 0.0;
  double standard_error = 0.0;      ///< > 0
  double degrees_of_freedom = 0.0;  ///< > 0

  [[nodiscard]] double statistic() const noexcept { return effect / standard_error; }
};

/// The side on which effects count against the null hypothesis.
enum class Tail { kTwoSided, kGreater, kLess };

/// The p value of the null hypothesis that there is no effect, or none on the side of the tail.
[[nodiscard]] double p_value_of(const EffectEstimate& estimate, Tail tail);

/// The interval with this confidence, 0 < confidence < 1.
[[nodiscard]] Interval interval_of(const EffectEstimate& estimate, double confidence);

/// The p value of two one-sided tests of whether the effect lies within (-margin, margin)
/// (Schuirmann 1987), which is the larger of the two. It is below alpha if the interval with
/// confidence 1 - 2 alpha lies within the margin. `margin` is > 0.
[[nodiscard]] double equivalence_p_value(const EffectEstimate& estimate, double margin);

/// The estimate from people's weighted sums. The effect is the sum of the groups' means, and
/// its variance the sum of the variances of these means. The degrees of freedom are those of
/// Welch (1947) and Satterthwaite (1946); a single group has n - 1 (Student). The result is
/// absent if a group has fewer than two people, or if nobody differs from anybody in the same
/// group.
[[nodiscard]] std::optional<EffectEstimate> contrast_estimate(
    const std::vector<std::vector<double>>& scores_by_group);

/// p values adjusted by Bonferroni: each is multiplied by their number, and is at most 1.
/// Absent values stay absent and do not count.
[[nodiscard]] std::vector<std::optional<double>> bonferroni_adjusted(
    const std::vector<std::optional<double>>& p_values);

}  // namespace jnd::analysis
