#pragma once

#include <optional>
#include <string>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// The stored answer of a question that was left out.
inline constexpr char kNoAnswer[] = "no_answer";

/// Reads a number as it was typed, whatever the locale. Returns none if the text holds anything
/// else.
[[nodiscard]] std::optional<double> number_in(const std::string& text);

/// Returns the answer to a scale, a number or a yes/no question as a number, where yes is 1 and
/// no is 0. Returns none for other answers, such as that of a question that was left out.
[[nodiscard]] std::optional<double> value_of_answer(const std::string& answer);

/// Whether `value_of_answer` gives a number for answers to this question.
[[nodiscard]] bool has_value(const QuestionnaireItem& item);

/// Returns what was expected if this is no valid answer: "a step from 1 to 10"; "" for a valid
/// one. Valid are words, a number within its limits, a step of the scale, the value of an
/// option, "yes" or "no", also "yes: which", and `kNoAnswer` if the question is not required.
/// Not real time.
[[nodiscard]] std::string expected_answer(const QuestionnaireItem& item,
                                          const std::string& answer);

}  // namespace jnd::experiments
