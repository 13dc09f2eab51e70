#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/data/questionnaire_items.h"
#include "analysis/data/stored_studies.h"
#include "analysis/export/exported_recording.h"
#include "analysis/export/table_writer.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// A trial whose answer stands.
struct ExportedTrial {
  core::TrialRow row;
  bool excluded = false;        ///< Set aside with a reason.
  bool is_practice = false;     ///< Whether the trial belongs to a practice block.
  std::string standard_medium;  ///< Medium of the reference; "" where it is the block's own.
};
/// In the order of the trials.
[[nodiscard]] std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                                         std::int64_t session);

/// The questions of study files, each file read once.
class StudyQuestions {
 public:
  explicit StudyQuestions(const core::StudyStore& store) : studies_(store) {}
  [[nodiscard]] const std::vector<QuestionnaireItem>& of(const core::SessionRow& session);

 private:
  StoredStudies studies_;
  std::map<std::string, std::vector<QuestionnaireItem>> by_hash_;
};

/// A presentation of such a trial.
struct ExportedPresentation {
  core::PresentationRow row;
  bool excluded = false;  ///< Its trial is.
};
[[nodiscard]] std::vector<ExportedPresentation> exported_presentations(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials);

/// Of a field of the study in a table of participants: its name, or "field_NAME" where the
/// table has a column of that name.
[[nodiscard]] std::string field_column(const std::string& field,
                                       const std::vector<std::string>& taken);

// A session's rows of each table, in the columns of study_tables.h.

/// `events`: of the session.
void write_session(TableWriter& table, const core::SessionRow& session, bool completed,
                   const std::vector<core::EventRow>& events);
void write_trials(TableWriter& table, const core::SessionRow& session,
                  const std::vector<ExportedTrial>& trials);
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
void write_gaps(TableWriter& table, const core::SessionRow& session,
                const ExportedRecording& recording);

/// A row for every column of every table, by the name that the data set gives the table.
void write_codebook(
    TableWriter& table,
    const std::vector<std::pair<std::string, const std::vector<CsvColumn>*>>& tables);

/// The cells of a trial after those of its owner, the row not ended: `simulated` is the first.
void write_trial_cells(TableWriter& table, const core::SessionRow& session,
                       const ExportedTrial& trial);

}  // namespace jnd::analysis
