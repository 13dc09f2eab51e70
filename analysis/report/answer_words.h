#pragma once

#include <optional>
#include <string>

#include "analysis/data/questionnaire_items.h"

namespace jnd::analysis {

/// The number that an answer is, such as 26 for "26.00".
[[nodiscard]] std::optional<double> number_of(const std::string& answer);

/// What a question is about. That is its name in words, such as "body height"; where this does
/// not say it, because one answers yes or no or because names are English, it is the question
/// itself.
[[nodiscard]] std::string item_words(const QuestionnaireItem& item);

/// An answer as a person would write it: "not said" for "not_said", 26 for "26.00", and an
/// option as the participant read it.
[[nodiscard]] std::string answer_words(const std::string& answer,
                                       const QuestionnaireItem& item);

}  // namespace jnd::analysis
