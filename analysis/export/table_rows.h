#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/data/questionnaire_items.h"
#include "analysis/data/stored_studies.h"
#include "analysis/export/export_options.h"
#include "core/storage/recorded_ticks.h"
#include "core/storage/study_store.h"
#include "experiments/procedures/procedure.h"

namespace jnd::analysis {

/// A trial whose answer stands.
struct ExportedTrial {
  core::TrialRow row;
  bool excluded = false;        ///< Set aside with a reason.
  bool is_practice = false;     ///< Whether the trial belongs to a practice block.
  std::string standard_medium;  ///< Medium of the reference; "" where it is the block's own.
  /// What its answer is; none where the study file has no such block.
  std::optional<experiments::Measure> measure;

  /// The answer, where it is one of that.
  [[nodiscard]] std::optional<double> response_if(experiments::Measure wanted) const {
    return measure == wanted ? row.response : std::nullopt;
  }
};
/// Those of the chosen blocks, in the order of the trials.
[[nodiscard]] std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                                         std::int64_t session,
                                                         const ExportSelection& selection);

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
  std::string block;      ///< Its trial's.
  bool excluded = false;  ///< Its trial is.
};
[[nodiscard]] std::vector<ExportedPresentation> exported_presentations(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials);

/// An answer to a question after a trial, beside the question.
struct ExportedAnswer {
  core::QuestionAnswerRow row;
  std::string kind, unit;       ///< Of the question; "" for one that the study has not.
  std::string asked;            ///< What was asked, and what the ends of a scale are.
  std::optional<double> value;  ///< Of a number or a scale.
  bool excluded = false;        ///< Its trial is.
};
/// Of the trials whose answer stands, in the order in which they were given.
[[nodiscard]] std::vector<ExportedAnswer> exported_question_answers(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials);

/// From the first to the last tick of each of the chosen blocks, ascending; empty where none is
/// chosen.
[[nodiscard]] std::vector<core::TickRange> ticks_of_blocks(
    const std::vector<ExportedTrial>& trials,
    const std::vector<ExportedPresentation>& presentations, const ExportSelection& selection);

/// Of a field of the study in a table of participants: its name, or "field_NAME" where the
/// table has a column of that name.
[[nodiscard]] std::string field_column(const std::string& field,
                                       const std::vector<std::string>& taken);

}  // namespace jnd::analysis
