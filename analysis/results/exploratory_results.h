#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Effects that nobody planned to test, each as one number for each participant, so that people
/// and not answers are counted:
///
/// - production: how far the set value follows the starting value;
/// - estimation and production: how answers change over the trials of a block;
/// - estimation: how an answer depends on the stimulus before it;
/// - every counterbalance (priming, order of two methods) and field: whether the participants'
///   own parameters, taken from `sections`, differ between its arms of at least two people.
///   Rows of a square and orders of three or more are not compared. Neither is k if people
///   chose their own numbers.
///
/// The t tests form one family, for `adjust_by_family`. The rank tests beside them have the
/// same hypotheses and belong to no family. There are no estimates and no comparisons if a
/// study has none of this.
[[nodiscard]] ResultsSection exploratory_results(const StudyData& data,
                                                 const std::vector<ResultsSection>& sections);

}  // namespace jnd::analysis
