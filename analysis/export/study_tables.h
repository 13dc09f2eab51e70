#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/export/exported_recording.h"
#include "analysis/export/factor_columns.h"
#include "analysis/export/table_rows.h"
#include "analysis/export/table_writer.h"

namespace jnd::analysis {

// The columns of every table, as codebook and sidecars tell them: one spelling for all data
// sets.

[[nodiscard]] const std::vector<CsvColumn>& session_columns();
[[nodiscard]] const std::vector<CsvColumn>& session_value_columns();
[[nodiscard]] const std::vector<CsvColumn>& participant_columns();
[[nodiscard]] const std::vector<CsvColumn>& trial_columns();
[[nodiscard]] const std::vector<CsvColumn>& presentation_columns();
[[nodiscard]] const std::vector<CsvColumn>& event_columns();
[[nodiscard]] const std::vector<CsvColumn>& answer_columns();
[[nodiscard]] const std::vector<CsvColumn>& questionnaire_columns();
[[nodiscard]] const std::vector<CsvColumn>& question_columns();
[[nodiscard]] const std::vector<CsvColumn>& marker_columns();
[[nodiscard]] const std::vector<CsvColumn>& gap_columns();
[[nodiscard]] const std::vector<CsvColumn>& codebook_columns();
[[nodiscard]] const std::vector<CsvColumn>& deviation_columns();

/// How many columns of trials say whose they are, not what was done: BIDS says that by the name
/// of the file.
inline constexpr std::size_t kNumTrialOwners = 2;

// A session's rows of each table.

/// `events`: of the session.
void write_session(TableWriter& table, const core::SessionRow& session, bool completed,
                   const std::vector<core::EventRow>& events);
/// What was known of the participant, the arms of counterbalances and the fitting of the
/// device, a row each.
void write_session_values(TableWriter& table, const core::SessionRow& session,
                          const std::vector<core::EventRow>& events);
void write_trials(TableWriter& table, const core::SessionRow& session,
                  const std::vector<ExportedTrial>& trials, FactorColumns& factors);
void write_presentations(TableWriter& table, const core::SessionRow& session,
                         const std::vector<ExportedPresentation>& presentations);
void write_events(TableWriter& table, const core::SessionRow& session,
                  const std::vector<core::EventRow>& events);
void write_answers(TableWriter& table, const core::SessionRow& session,
                   const std::vector<core::AnswerRow>& answers);
/// The questions of the session's study file, with what of the answers belongs to each.
void write_questionnaire(TableWriter& table, const core::SessionRow& session,
                         const std::vector<core::AnswerRow>& answers,
                         const std::vector<QuestionnaireItem>& questions);
/// Answers to questions after trials, a row each.
void write_questions(TableWriter& table, const core::SessionRow& session,
                     const std::vector<ExportedAnswer>& answers);
/// The cells of such an answer after those of its owner, the row not ended.
void write_question_cells(TableWriter& table, const core::SessionRow& session,
                          const ExportedAnswer& answer);
/// Pulses that were sent to another recorder, a row each, with the event that each tells of.
void write_markers(TableWriter& table, const core::SessionRow& session,
                   const std::vector<core::EventRow>& events);
void write_gaps(TableWriter& table, const core::SessionRow& session,
                const ExportedRecording& recording);

/// A row for each thing that is not as it was registered.
void write_deviations(TableWriter& table, const PreregisteredStudy& preregistration);

/// A row for every column of every table, by the name that the data set gives the table.
void write_codebook(
    TableWriter& table,
    const std::vector<std::pair<std::string, const std::vector<CsvColumn>*>>& tables);

/// The cells of a trial after those of its owner, the levels of factors last, the row not
/// ended: `simulated` is the first.
void write_trial_cells(TableWriter& table, const core::SessionRow& session,
                       const ExportedTrial& trial, FactorColumns& factors);

}  // namespace jnd::analysis
