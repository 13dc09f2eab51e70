#pragma once

#include <set>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// More than this share of a block's answers affected is enough to be asked what they did.
inline constexpr double kMostAffected = 0.02;

/// Counts of every level of every block but practice; catch trials are a level of their own.
/// Blocks in which the answers or people set more than 32 levels are counted as a whole.
[[nodiscard]] std::vector<LevelLoss> level_losses(const StudyData& data);

/// Share of a block's answers that are `TrialRecord::is_affected`; 0 without answers.
[[nodiscard]] double affected_ratio(const StudyData& data, const std::string& block);

/// The same data without those answers of these blocks.
[[nodiscard]] StudyData without_affected(const StudyData& data,
                                         const std::set<std::string>& blocks);

/// Beside every primary value of a block with more than `kMostAffected`, the same without these
/// trials: NAME.without_affected_trials; and a caution at the primary value where that lies
/// outside of its interval. Where a rule chose the stimuli by its answers there is none, with
/// the reason. Estimates have to be marked primary. Not real time.
void add_without_affected(StudyResults& results, const StudyData& data,
                          const ResultsOptions& options);

}  // namespace jnd::analysis
