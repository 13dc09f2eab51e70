#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/operator/session_view.h"

namespace jnd::app {

/// Fills in the words of the card from everything else in the view: heading, sentence, what to
/// say, the hand sign, and the text for the participant's screen. `instruction` is that of the
/// stage under way in the participant's language; it may be empty.
void add_words(SessionView& view, std::string_view stage_title, std::string_view instruction);

/// An intensity as it is shown: "1.65 Pa s", "scale 2", "300 N/m". `quantity` is as in studies.
[[nodiscard]] std::string level_words(const std::string& quantity, double intensity);

/// An answer as it is shown: "yes", "120 %", "2.4", "first".
[[nodiscard]] std::string answer_words(experiments::AnswerKind kind, double answer);

/// Contact points by their bits: "the index finger", "the inner palm and the thumb"; "" for
/// none.
[[nodiscard]] std::string told_points(std::uint8_t bits);

/// A number for people: rounded to up to three significant digits, without trailing zeros.
[[nodiscard]] std::string number_words(double value);

}  // namespace jnd::app
