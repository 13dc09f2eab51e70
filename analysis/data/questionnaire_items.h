#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_rows.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// A question of a study, as far as it is needed to read its answers. It belongs to a
/// questionnaire or follows the experiment.
struct QuestionnaireItem {
  std::string stage;
  std::string name;  ///< For example "safety".
  std::string
      kind;  ///< "number", "text", "choice", "yes_no", "yes_no_which", "scale" or "words".
  std::string question;  ///< The question in English, or in the first available language.
  std::string unit;      ///< The unit of a number; "" if there is none.
  int num_steps = 0;     ///< The number of steps of a scale, which are counted from 1.
  /// For a scale: whether the last step is the favourable end. It is absent if neither end is.
  std::optional<bool> high_is_good{};
  std::vector<std::string> options;  ///< The options of a choice, as they are stored.
  std::vector<std::string>
      option_labels;  ///< The options as people read them, in the question's language.
  std::string low_label, high_label;  ///< The labels at the ends of a scale.
};

/// The questions of a study in their order, including those of every arm.
[[nodiscard]] std::vector<QuestionnaireItem> questionnaire_items(
    const experiments::Study& study);

/// The stage that holds answers known before the session.
inline constexpr char kFieldsStage[] = "participant";

/// What is asked about participants before a session, as choices of that stage.
[[nodiscard]] std::vector<QuestionnaireItem> participant_fields(
    const experiments::Study& study);

/// Adds new items. An item with the same stage and name is replaced, so the last version of a
/// study file applies.
void merge_items(std::vector<QuestionnaireItem>& items, std::vector<QuestionnaireItem> added);

/// What one person answered to an item, for each time that its stage came, in order; "" where
/// they left it out. `answers`: of all their sessions, of which the last one counts.
[[nodiscard]] std::vector<std::string> answers_by_time(
    const std::vector<core::AnswerRow>& answers, const QuestionnaireItem& item);

}  // namespace jnd::analysis
