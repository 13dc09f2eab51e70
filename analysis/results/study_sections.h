#pragma once

#include <optional>

#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

// Sections about the whole study, which follow those of its blocks. They are absent if there
// are no data. Not real time.

/// How many trials everybody practised, how many of the last ones were right, and whether that
/// was enough.
[[nodiscard]] std::optional<ResultsSection> practice_results(const StudyData& data);
/// How long answers took, by block: everybody's median, and its geometric mean over people with
/// Student's interval of the logarithms. Absent if no times were kept.
[[nodiscard]] std::optional<ResultsSection> response_time_results(const StudyData& data);
/// How often the answer was "cannot tell", and how often answers missed their deadline, in the
/// blocks that permit this: everybody's counts, and the mean over people of their shares.
[[nodiscard]] std::optional<ResultsSection> unanswered_results(const StudyData& data);
/// The answers outside of trials by item, as in tables D.3 and D.4 of the thesis:
///
/// - scales: mean, standard deviation and median, with everybody's own value. If one end is
///   favourable, scales are turned so that 1 is the worst step.
/// - numbers: mean, standard deviation, smallest and largest, with everybody's own value;
/// - choices and yes-no questions: how many participants gave each answer;
/// - words: as they were written, in `free_answers`.
///
/// Absent for a study without questions. Participants without any answer in a stage with
/// questions are named as excluded; if nobody has one, a single entry says so.
[[nodiscard]] std::optional<ResultsSection> questionnaire_results(const StudyData& data);

/// In the order of the results and the report. A new section needs a file of its own and an
/// entry here.
inline constexpr std::optional<ResultsSection> (*kStudySections[])(const StudyData&) = {
    practice_results, unanswered_results, response_time_results, questionnaire_results};

}  // namespace jnd::analysis
