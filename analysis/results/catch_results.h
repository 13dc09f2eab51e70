#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Whether anybody answered catch trials in a block of comparisons, where the test equals the
/// reference. Catch trials of yes-no and same-different tasks belong to the results of those
/// blocks.
[[nodiscard]] bool has_catch_trials(const StudyData& data, const BlockDesign& block);

/// The number of catch trials and their answers, for everybody and for the group, in the
/// section BLOCK_catch_trials. In a reminder task it reports how often "more" was said without
/// cause. With two intervals either answer is right by chance, so it reports how often the
/// interval drawn for the test was chosen, and how often the second one was. Catch trials are
/// in no curve. Not real time.
[[nodiscard]] ResultsSection catch_results(const StudyData& data, const BlockDesign& block);

}  // namespace jnd::analysis
