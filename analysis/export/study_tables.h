#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/export/exported_recording.h"
#include "analysis/export/factor_columns.h"
#include "analysis/export/table_rows.h"
#include "analysis/export/table_writer.h"

namespace jnd::analysis {

// The columns of every table with the names that the codebook and sidecars use, so that all
// data sets spell them alike.

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

/// The number of columns of trials that say whose the trial is. BIDS says this in the name of
/// the file.
inline constexpr std::size_t kNumTrialOwners = 2;

// These functions write a session's rows of each table.

/// `events` are those of the session.
void write_session(TableWriter& table, const core::SessionRow& session, bool completed,
                   const std::vector<core::EventRow>& events);
/// Writes one row each for what was known about the participant, the arms of counterbalances
/// and the fitting of the device.
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
/// Writes the questions of the session's study file, with the answers that belong to each.
void write_questionnaire(TableWriter& table, const core::SessionRow& session,
                         const std::vector<core::AnswerRow>& answers,
                         const std::vector<QuestionnaireItem>& questions);
/// Writes one row for each answer to a question after a trial.
void write_questions(TableWriter& table, const core::SessionRow& session,
                     const std::vector<ExportedAnswer>& answers);
/// Writes the cells of such an answer after those of its owner. It does not end the row.
void write_question_cells(TableWriter& table, const core::SessionRow& session,
                          const ExportedAnswer& answer);
/// Writes one row for each pulse that was sent to another recorder, with the event that it
/// marks.
void write_markers(TableWriter& table, const core::SessionRow& session,
                   const std::vector<core::EventRow>& events);
void write_gaps(TableWriter& table, const core::SessionRow& session,
                const ExportedRecording& recording);

/// Writes one row for each deviation from the preregistration.
void write_deviations(TableWriter& table, const PreregisteredStudy& preregistration);

/// Writes one row for every column of every table, with the name of the table in the data set.
void write_codebook(
    TableWriter& table,
    const std::vector<std::pair<std::string, const std::vector<CsvColumn>*>>& tables);

/// Writes the cells of a trial after those of its owner. `simulated` comes first, and the
/// levels of factors last. It does not end the row.
void write_trial_cells(TableWriter& table, const core::SessionRow& session,
                       const ExportedTrial& trial, FactorColumns& factors);

}  // namespace jnd::analysis
