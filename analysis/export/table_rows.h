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

/// A trial with a valid answer.
struct ExportedTrial {
  core::TrialRow row;
  bool excluded = false;        ///< Whether it was set aside with a reason.
  bool is_practice = false;     ///< Whether the trial belongs to a practice block.
  std::string standard_medium;  ///< The medium of the reference; "" if it is the block's own.
  /// The kind of its answer; absent if the study file has no such block.
  std::optional<experiments::Measure> measure;

  /// The answer, if it is of the wanted kind.
  [[nodiscard]] std::optional<double> response_if(experiments::Measure wanted) const {
    return measure == wanted ? row.response : std::nullopt;
  }
};
/// The trials of the chosen blocks, in their order.
[[nodiscard]] std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                                         std::int64_t session,
                                                         const ExportSelection& selection);

/// The questions of study files. Each file is read once.
class StudyQuestions {
 public:
  explicit StudyQuestions(const core::StudyStore& store) : studies_(store) {}
  [[nodiscard]] const std::vector<QuestionnaireItem>& of(const core::SessionRow& session);

 private:
  StoredStudies studies_;
  std::map<std::string, std::vector<QuestionnaireItem>> by_hash_;
};

/// A presentation of an exported trial.
struct ExportedPresentation {
  core::PresentationRow row;
  std::string block;      ///< The block of its trial.
  bool excluded = false;  ///< Whether its trial was set aside.
};
[[nodiscard]] std::vector<ExportedPresentation> exported_presentations(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials);

/// An answer to a question after a trial, with the question.
struct ExportedAnswer {
  core::QuestionAnswerRow row;
  /// The kind and unit of the question; "" if the study does not have it.
  std::string kind, unit;
  std::string asked;            ///< The question, with the labels of a scale's ends.
  std::optional<double> value;  ///< The value of a number or a scale.
  bool excluded = false;        ///< Whether its trial was set aside.
};
/// The answers after trials with a valid answer, in the order in which they were given.
[[nodiscard]] std::vector<ExportedAnswer> exported_question_answers(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials);

/// The ticks from the first to the last of each chosen block, ascending; empty if none is
/// chosen.
[[nodiscard]] std::vector<core::TickRange> ticks_of_blocks(
    const std::vector<ExportedTrial>& trials,
    const std::vector<ExportedPresentation>& presentations, const ExportSelection& selection);

/// The name of a field's column in a table of participants: the field's name, or "field_NAME"
/// if the table already has a column of that name.
[[nodiscard]] std::string field_column(const std::string& field,
                                       const std::vector<std::string>& taken);

}  // namespace jnd::analysis
