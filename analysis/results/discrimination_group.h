#pragma once

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// The pse of the primary analysis. It is usually free and personal in each condition. If
/// either interval may hold the test (in both blocks if there are two), equal test and
/// reference differ only in their order, and are chosen equally often over both orders. The pse
/// is then at the reference, and people differ in their bias for an interval.
[[nodiscard]] HierarchicalPse primary_pse(const std::vector<DiscriminationAnswers>& answers);
[[nodiscard]] HierarchicalPse primary_pse(const std::vector<DiscriminationAnswers>& first,
                                          const std::vector<DiscriminationAnswers>& second);

/// Adds the Weber fraction and pse of the pooled curve and of the median person in one block,
/// with the estimand in `meaning`. They are computed with a free pse and with the pse at the
/// reference; one of these is primary. If a participant is degenerate or a trial was set aside,
/// they are computed without and with those.
void add_group_estimates(ResultsSection& section, const StudyData& data,
                         const BlockDesign& block, const ResultsOptions& options);

/// Adds only the primary estimate, from the answers in `data`. It adds nothing if there are
/// none.
void add_primary_estimate(ResultsSection& section, const StudyData& data,
                          const BlockDesign& block, const ResultsOptions& options);

/// The difference of two blocks in the median person's ln ln(1 + w), first minus second. The
/// slopes of the same person are correlated.
[[nodiscard]] Comparison median_person_difference(
    const std::vector<DiscriminationAnswers>& first_answers, const BlockDesign& first,
    const std::vector<DiscriminationAnswers>& second_answers, const BlockDesign& second,
    HierarchicalPse pse);

}  // namespace jnd::analysis
