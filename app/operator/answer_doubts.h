#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/language/words.h"
#include "experiments/procedures/procedure.h"

namespace jnd::app {

// What speaks against an answer: that it was mistyped, given by chance, or given to something
// that nobody has felt. Nothing of it is forbidden. The window asks before such an answer is
// stored, and says it beside the answer afterwards.

/// Of water, or of the standard: ten times as strong. In the studies of Schmidt (2018) the
/// largest mean estimate is below 250 %.
inline constexpr double kMostLikelyPercent = 1000.0;
/// From one answer of a block to the next. The stimuli of a block are hardly ever further apart
/// than 1 to 20, and answers are mostly closer together than those: a zero too many is a factor
/// of 10, two are 100.
inline constexpr double kMostLikelyStep = 20.0;
/// Nobody feels, judges and answers in less: a choice between two takes half a second by
/// itself.
inline constexpr double kLeastLikelyAnswer_s = 0.5;

/// What is known of an answer, as it was given.
struct GivenAnswer {
  experiments::AnswerKind kind = experiments::AnswerKind::kYesNo;
  std::optional<double> value;       ///< Percent, number or choice; none: "cannot tell".
  std::optional<double> last_value;  ///< Of the last answer of its block; none for the first.
  /// For how long the stimulus that was felt last had been felt, in the whole attempt.
  std::optional<double> felt_s;
  /// Stimuli of the attempt without a single stroke: "test", "reference", "first" ...
  std::vector<std::string> unstroked;
};

struct AnswerDoubt {
  std::string shown;   ///< "700 times the last answer", in the language of the window.
  std::string stored;  ///< The same for the study's log.
};

/// Empty for an answer like any other.
[[nodiscard]] std::vector<AnswerDoubt> doubts_about(const GivenAnswer& given);

/// What is shown of them, in one line: "no stroke in the test; ..."; "" for none.
[[nodiscard]] std::string shown_doubts(const std::vector<AnswerDoubt>& doubts);
/// The same for the log.
[[nodiscard]] std::string stored_doubts(const std::vector<AnswerDoubt>& doubts);

/// What every note begins with that tells what became of such an answer.
inline constexpr const char* kNoteOfDoubt = as_is("asked about the answer ");
/// Whether nobody wrote this note: it is one of those.
[[nodiscard]] bool is_note_of_doubt(std::string_view note) noexcept;

}  // namespace jnd::app
