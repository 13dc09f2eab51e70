#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_rows.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// A question of a study, as far as its answers have to be read: of a questionnaire or after
/// the experiment.
struct QuestionnaireItem {
  std::string stage;
  std::string name;  ///< "safety"
  std::string
      kind;  ///< "number", "text", "choice", "yes_no", "yes_no_which", "scale", "words".
  std::string question;  ///< In English, or in the first language there is.
  std::string unit;      ///< Unit of a number; "" where there is none.
  int num_steps = 0;     ///< Steps of a scale, counted from 1.
  /// Of a scale: whether the last step is the favourable end; absent where neither is.
  std::optional<bool> high_is_good{};
  std::vector<std::string> options;  ///< Options of a choice, in the words that are stored.
  std::vector<std::string>
      option_labels;  ///< Options as people read them, in the question's language.
  std::string low_label, high_label;  ///< Of a scale: what stands at its ends.
};

/// The questions of a study in their order, those of every arm among them.
[[nodiscard]] std::vector<QuestionnaireItem> questionnaire_items(
    const experiments::Study& study);

/// Stage that answers are stored under which were known before the session.
inline constexpr char kFieldsStage[] = "participant";

/// What is asked of participants before a session, as choices of that stage.
[[nodiscard]] std::vector<QuestionnaireItem> participant_fields(
    const experiments::Study& study);

/// Adds the items that are new; one of the same stage and name is replaced, so that the last
/// version of a study file is in force.
void merge_items(std::vector<QuestionnaireItem>& items, std::vector<QuestionnaireItem> added);

/// What one person answered to an item, for each time that its stage came, in order; "" where
/// they left it out. `answers`: of all their sessions, of which the last one counts.
[[nodiscard]] std::vector<std::string> answers_by_time(
    const std::vector<core::AnswerRow>& answers, const QuestionnaireItem& item);

}  // namespace jnd::analysis
