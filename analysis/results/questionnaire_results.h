#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// What was answered outside of trials, item by item, as in tables D.3 and D.4 of the thesis:
/// - scales: mean, standard deviation and median, turned so that 1 is the worst step, where one
///   end is the favourable one, with everybody's own;
/// - numbers: mean, standard deviation, smallest and largest, with everybody's own;
/// - choices, yes or no: how many participants gave which answer;
/// - words: as they were written, in `free_answers`.
/// Empty for a study without questions. Who has no answer at all in a stage with questions is
/// named as excluded; once, where nobody has.
[[nodiscard]] ResultsSection questionnaire_results(const StudyData& data);

}  // namespace jnd::analysis
