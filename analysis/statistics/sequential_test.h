#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "analysis/statistics/effect_test.h"
#include "analysis/statistics/group_sequential.h"

namespace jnd::analysis {

/// When a study is looked at, and what ends it.
struct SequentialRule {
  std::vector<int> looks;  ///< Ascending numbers of people. The last is the whole study.
  SpendingFunction spending = SpendingFunction::kObrienFleming;
  double alpha = 0.05;  ///< The alpha of the whole study, for any number of looks.
  Tail tail = Tail::kTwoSided;
};

/// The rule with its boundaries. Samples are small, so the boundaries apply to p values of t
/// tests: a look at which p is below its nominal level ends the study (Jennison and Turnbull
/// 2000, chapter 4).
struct SequentialBoundaries {
  SequentialRule rule;
  /// The boundary of each look, > 0. It is infinite if nothing can end the study there.
  std::vector<double> z;
  /// The nominal level of each look, for a p with the rule's tail.
  std::vector<double> nominal_level;
};
/// Throws `core::Error` if the looks do not ascend. Not real time.
[[nodiscard]] SequentialBoundaries boundaries_of(const SequentialRule& rule);

/// Whether this estimate at this look (counted from 0) ends the study. Without an estimate
/// nothing does.
[[nodiscard]] bool crosses(const SequentialBoundaries& boundaries, std::size_t look,
                           const std::optional<EffectEstimate>& estimate);

/// A person's weighted sum, and the person's group.
struct PersonScore {
  std::size_t group = 0;
  double score = 0.0;
};
/// The estimate from the first `num_people` people (`contrast_estimate`). People without a
/// score are left out.
[[nodiscard]] std::optional<EffectEstimate> estimate_of_first(
    const std::vector<std::optional<PersonScore>>& people, std::size_t num_people,
    std::size_t num_groups);

/// How far a study has come under its rule.
struct SequentialOutcome {
  /// The estimate at each look that was taken, up to the one that ended the study.
  std::vector<std::optional<EffectEstimate>> estimates;
  bool significant = false;  ///< Whether the last look crossed its boundary.
  bool ended = false;        ///< Whether a boundary was crossed or no further look is left.
};
/// `estimates` holds one entry for each look that has enough people. Entries after the end are
/// dropped.
[[nodiscard]] SequentialOutcome sequential_outcome(
    const SequentialBoundaries& boundaries,
    const std::vector<std::optional<EffectEstimate>>& estimates);

}  // namespace jnd::analysis
