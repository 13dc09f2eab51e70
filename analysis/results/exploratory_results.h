#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// What nobody set out to test, each effect as one number a participant, so that people and not
/// answers are counted:
/// - production: how far the set value follows the starting value;
/// - estimation and production: how answers change over the trials of a block;
/// - estimation: how an answer leans on the stimulus before it;
/// - every counterbalance (priming, order of two methods) and field: whether the participants'
///   own parameters, taken from `sections`, differ between its arms of two people or more. Rows
///   of a square and orders of three or more are not compared, and neither is k where people
///   chose their own numbers.
/// The t tests are one family, for `adjust_by_family`; the rank tests beside them are of the
/// same hypotheses and belong to none.
/// No estimates and no comparisons where a study has nothing of this.
[[nodiscard]] ResultsSection exploratory_results(const StudyData& data,
                                                 const std::vector<ResultsSection>& sections);

}  // namespace jnd::analysis
