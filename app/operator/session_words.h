#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/operator/session_view.h"

namespace jnd::app {

/// Fills in what the card says: heading, sentence, what to say, the hand sign to show, and the
/// words for the participant's screen, from everything else in the view. `instruction`: of the
/// stage under way, in the participant's language; may be empty.
void add_words(SessionView& view, std::string_view stage_title, std::string_view instruction);

/// "1.65 Pa s", "scale 2", "300 N/m": an intensity as it is shown. `quantity` as in studies.
[[nodiscard]] std::string level_words(const std::string& quantity, double intensity);

/// "yes", "120 %", "2.4", "first": an answer as it is shown.
[[nodiscard]] std::string answer_words(experiments::AnswerKind kind, double answer);

/// "the index finger", "the inner palm and the thumb": contact points by their bits; "" for
/// none.
[[nodiscard]] std::string told_points(std::uint8_t bits);

/// A number for people: up to three significant digits after rounding, no trailing zeros.
[[nodiscard]] std::string number_words(double value);

}  // namespace jnd::app
