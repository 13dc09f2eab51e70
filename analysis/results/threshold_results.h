#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

// Results of blocks that ask for a threshold otherwise than by constant stimuli in a reminder
// task, a section each. Not real time.

/// "Is it felt?" of the test alone: the intensity at 50 %, also corrected for false alarms,
/// and d' and criterion where there are catch trials.
[[nodiscard]] ResultsSection detection_results(const StudyData& data, const BlockDesign& block,
                                               const ResultsOptions& options);

/// "Same" or "different": the Weber fraction by the differencing model, the criterion and
/// false alarms.
[[nodiscard]] ResultsSection same_different_results(const StudyData& data,
                                                    const BlockDesign& block);

/// "Which interval?" of three: the Weber fraction at which the share of right answers is half
/// way from a guess to 1, right answers against guessing, and how often each interval is named.
[[nodiscard]] ResultsSection identification_results(const StudyData& data,
                                                    const BlockDesign& block);

/// What the block's own rule comes to, from `StudyData::runs`: section BLOCK_staircase,
/// BLOCK_limits or BLOCK_quest_plus.
[[nodiscard]] ResultsSection adaptive_results(const StudyData& data, const BlockDesign& block);

/// Where the test comes in the first or in the second interval: how much more often the second
/// one is chosen, and how far apart the pses of both orders lie. Section BLOCK_intervals.
[[nodiscard]] ResultsSection interval_results(const StudyData& data, const BlockDesign& block);

/// Whether any trial of the block says in which interval the test came.
[[nodiscard]] bool has_intervals(const StudyData& data, const BlockDesign& block);

}  // namespace jnd::analysis
