#pragma once

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// The pse of the primary analysis: free, and personal in each condition. But where either
/// interval may hold the test, in both blocks if there are two, nothing besides the order tells
/// test and reference apart when they are alike, so that they are answered half and half over
/// the orders: then the pse is at the reference, and people differ by their bias for an
/// interval.
[[nodiscard]] HierarchicalPse primary_pse(const std::vector<DiscriminationAnswers>& answers);
[[nodiscard]] HierarchicalPse primary_pse(const std::vector<DiscriminationAnswers>& first,
                                          const std::vector<DiscriminationAnswers>& second);

/// Adds the pooled curve's and the median person's Weber fraction and pse of one block, each
/// with its estimand in `meaning`: with the pse free and at the reference, one of which is
/// primary; and, where somebody is degenerate or a trial was set aside, without and with those.
void add_group_estimates(ResultsSection& section, const StudyData& data,
                         const BlockDesign& block, const ResultsOptions& options);

/// Adds the primary one of these alone, from as much of the answers as `data` holds; nothing
/// without any.
void add_primary_estimate(ResultsSection& section, const StudyData& data,
                          const BlockDesign& block, const ResultsOptions& options);

/// Difference of two blocks in the median person's ln ln(1 + w), slopes of the same person
/// correlated, first minus second.
[[nodiscard]] Comparison median_person_difference(
    const std::vector<DiscriminationAnswers>& first_answers, const BlockDesign& first,
    const std::vector<DiscriminationAnswers>& second_answers, const BlockDesign& second,
    HierarchicalPse pse);

}  // namespace jnd::analysis
