#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

// Results of blocks that ask for a threshold by other means than constant stimuli in a reminder
// task. Each has a section of its own. Not real time.

/// For "is it felt?" about the test alone: the intensity at 50 %, also corrected for false
/// alarms, and with catch trials d' and the criterion.
[[nodiscard]] ResultsSection detection_results(const StudyData& data, const BlockDesign& block,
                                               const ResultsOptions& options);

/// For "same" or "different": the Weber fraction by the differencing model, the criterion and
/// false alarms.
[[nodiscard]] ResultsSection same_different_results(const StudyData& data,
                                                    const BlockDesign& block);

/// For "which interval?" of three: the Weber fraction at which the share of right answers is
/// half way between guessing and 1, right answers against guessing, and how often each interval
/// is chosen.
[[nodiscard]] ResultsSection identification_results(const StudyData& data,
                                                    const BlockDesign& block);

/// The result of the block's own rule, from `StudyData::runs`, in the section BLOCK_staircase,
/// BLOCK_limits or BLOCK_quest_plus.
[[nodiscard]] ResultsSection adaptive_results(const StudyData& data, const BlockDesign& block);

/// If the test may come in the first or the second interval: how much more often the second is
/// chosen, and how far apart the pses of both orders lie. The section is BLOCK_intervals.
[[nodiscard]] ResultsSection interval_results(const StudyData& data, const BlockDesign& block);

/// Whether any trial of the block says in which interval the test came.
[[nodiscard]] bool has_intervals(const StudyData& data, const BlockDesign& block);

}  // namespace jnd::analysis
