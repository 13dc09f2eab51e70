#pragma once

#include <set>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// If more than this share of a block's answers is affected, the results are also computed
/// without them.
inline constexpr double kMostAffected = 0.02;

/// Counts for every level of every block except practice. Catch trials are a level of their
/// own. A block with more than 32 levels, which the answers or the people set, is counted as a
/// whole.
[[nodiscard]] std::vector<LevelLoss> level_losses(const StudyData& data);

/// The share of a block's answers that are `TrialRecord::is_affected`; 0 without answers.
[[nodiscard]] double affected_ratio(const StudyData& data, const std::string& block);

/// The same data without the affected answers of these blocks.
[[nodiscard]] StudyData without_affected(const StudyData& data,
                                         const std::set<std::string>& blocks);

/// For each block with more than `kMostAffected`, adds NAME.without_affected_trials for every
/// primary value: the same value without these trials. The primary value gets a caution if that
/// lies outside its interval. If a rule chose the stimuli from the answers, there is no such
/// value, and the reason says so. Estimates must be marked as primary before. Not real time.
void add_without_affected(StudyResults& results, const StudyData& data,
                          const ResultsOptions& options);

}  // namespace jnd::analysis
