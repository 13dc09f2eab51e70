#pragma once

#include <optional>
#include <string>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// Stored for a question that was left out.
inline constexpr char kNoAnswer[] = "no_answer";

/// A number as it was typed, whatever the locale; none where there is more or something else.
[[nodiscard]] std::optional<double> number_in(const std::string& text);

/// What was expected where a question cannot be answered so: "a step from 1 to 10"; "" where it
/// can. Words, a number within its ends, a step of the scale, the value of an option, "yes" or
/// "no", also "yes: which"; `kNoAnswer` where the question is not required. Not real time.
[[nodiscard]] std::string expected_answer(const QuestionnaireItem& item,
                                          const std::string& answer);

}  // namespace jnd::experiments
