#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/statistics/effect_test.h"
#include "analysis/statistics/group_sequential.h"

namespace jnd::analysis {

/// When a study is looked at, and what ends it.
struct SequentialRule {
  std::vector<int> looks;  ///< Numbers of people, ascending; the last is the whole study.
  SpendingFunction spending = SpendingFunction::kObrienFleming;
  double alpha = 0.05;  ///< Of the whole study, whatever number of looks.
  Tail tail = Tail::kTwoSided;
};

/// The same with its boundaries. Samples are small, so they hold for p values of t tests: a
/// look at which p is below its nominal level ends the study (Jennison and Turnbull 2000,
/// chapter 4).
struct SequentialBoundaries {
  SequentialRule rule;
  std::vector<double> z;              ///< By look, > 0; infinite where nothing can end it.
  std::vector<double> nominal_level;  ///< By look, of p as the tail has it.
};
/// Throws `core::Error` for looks that do not ascend. Not real time.
[[nodiscard]] SequentialBoundaries boundaries_of(const SequentialRule& rule);

/// Whether this estimate at this look, from 0, ends the study. Without one, nothing does.
[[nodiscard]] bool crosses(const SequentialBoundaries& boundaries, std::size_t look,
                           const std::optional<EffectEstimate>& estimate);

/// A person's weighted sum, in the group that the person is of.
struct PersonScore {
  std::size_t group = 0;
  double score = 0.0;
};
/// What the first `num_people` come to (`contrast_estimate`); who has no score is left out.
[[nodiscard]] std::optional<EffectEstimate> estimate_of_first(
    const std::vector<std::optional<PersonScore>>& people, std::size_t num_people,
    std::size_t num_groups);

/// How far a study has come by its rule.
struct SequentialOutcome {
  /// At each look that was taken, until the one that ended the study.
  std::vector<std::optional<EffectEstimate>> estimates;
  bool significant = false;  ///< The last of them crossed its boundary.
  bool ended = false;        ///< It did, or there is no further look.
};
/// `estimates`: at each look that there are people for. Those after the end are dropped.
[[nodiscard]] SequentialOutcome sequential_outcome(
    const SequentialBoundaries& boundaries,
    const std::vector<std::optional<EffectEstimate>>& estimates);

}  // namespace jnd::analysis
