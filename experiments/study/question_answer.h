#pragma once

#include <optional>
#include <string>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// Stored for a question that was left out.
inline constexpr char kNoAnswer[] = "no_answer";

/// A number as it was typed, whatever the locale; none where there is more or something else.
[[nodiscard]] std::optional<double> number_in(const std::string& text);

/// The answer to a scale, a number or yes or no as a number: yes is 1 and no is 0. None where
/// it is neither, as of a question that was left out.
[[nodiscard]] std::optional<double> value_of_answer(const std::string& answer);

/// Whether `value_of_answer` says what an answer to this question comes to.
[[nodiscard]] bool has_value(const QuestionnaireItem& item);

/// What was expected where a question cannot be answered so: "a step from 1 to 10"; "" where it
/// can. Words, a number within its ends, a step of the scale, the value of an option, "yes" or
/// "no", also "yes: which"; `kNoAnswer` where the question is not required. Not real time.
[[nodiscard]] std::string expected_answer(const QuestionnaireItem& item,
                                          const std::string& answer);

}  // namespace jnd::experiments
