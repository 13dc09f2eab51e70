#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Whether anybody answered catch trials in a block of comparisons, in which the test equals
/// the reference. Those of yes-no and same-different tasks belong to their own results.
[[nodiscard]] bool has_catch_trials(const StudyData& data, const BlockDesign& block);

/// How many there were and what was answered, of everybody and of the group; section
/// BLOCK_catch_trials. Of a reminder "more" without cause; of two intervals, where either
/// answer is by chance, how often the one that was drawn for the test was chosen, and how often
/// the second one. They are in no curve. Not real time.
[[nodiscard]] ResultsSection catch_results(const StudyData& data, const BlockDesign& block);

}  // namespace jnd::analysis
