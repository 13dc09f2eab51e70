#pragma once

#include <optional>

#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

// Sections of the whole study, which stand behind those of its blocks. Nothing where there are
// no data. Not real time.

/// How many trials everybody practised, how many of the last ones were right, and whether that
/// was enough.
[[nodiscard]] std::optional<ResultsSection> practice_results(const StudyData& data);
/// How long answers took, block by block: everybody's median, and over people its geometric
/// mean with Student's interval of the logarithms. Nothing where no time was kept.
[[nodiscard]] std::optional<ResultsSection> response_time_results(const StudyData& data);
/// How often answers were "cannot tell" and how often they missed their deadline, in the blocks
/// where they can: everybody's counts, and over people the mean of their shares.
[[nodiscard]] std::optional<ResultsSection> unanswered_results(const StudyData& data);
/// What was answered outside of trials, item by item, as in tables D.3 and D.4 of the thesis:
/// - scales: mean, standard deviation and median, turned so that 1 is the worst step, where one
///   end is the favourable one, with everybody's own;
/// - numbers: mean, standard deviation, smallest and largest, with everybody's own;
/// - choices, yes or no: how many participants gave which answer;
/// - words: as they were written, in `free_answers`.
/// Nothing for a study without questions. Who has no answer at all in a stage with questions is
/// named as excluded; once, where nobody has.
[[nodiscard]] std::optional<ResultsSection> questionnaire_results(const StudyData& data);

/// In the order of results and report. A new one is a file of its own and a place here.
inline constexpr std::optional<ResultsSection> (*kStudySections[])(const StudyData&) = {
    practice_results, unanswered_results, response_time_results, questionnaire_results};

}  // namespace jnd::analysis
