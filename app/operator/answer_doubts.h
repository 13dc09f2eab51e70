#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/language/words.h"
#include "experiments/procedures/procedure.h"

namespace jnd::app {

// Doubts about an answer: it may have been mistyped, given by chance, or given to something
// that nobody has felt. No such answer is forbidden. The window asks before it is stored, and
// shows the doubt beside the answer afterwards.

/// The largest likely answer, in percent of water or of the standard: ten times as strong. In
/// the studies of Schmidt (2018), the largest mean estimate is below 250 %.
inline constexpr double kMostLikelyPercent = 1000.0;
/// The largest likely ratio of one answer to the next in a block. The stimuli of a block hardly
/// ever differ by more than 1 to 20, and answers mostly differ less than those. One zero too
/// many is a factor of 10, two are 100.
inline constexpr double kMostLikelyStep = 20.0;
/// The shortest likely time in which somebody feels, judges and answers; a choice between two
/// alone takes half a second.
inline constexpr double kLeastLikelyAnswer_s = 0.5;

/// What is known about an answer as it was given.
struct GivenAnswer {
  experiments::AnswerKind kind = experiments::AnswerKind::kYesNo;
  /// A percentage, a number or a choice; none for "cannot tell".
  std::optional<double> value;
  /// The last answer of the block before this one; none for the first.
  std::optional<double> last_value;
  /// For how long the last stimulus was felt, in the whole attempt.
  std::optional<double> felt_s;
  /// The stimuli of the attempt without a single stroke: "test", "reference", "first" ...
  std::vector<std::string> unstroked;
};

struct AnswerDoubt {
  /// In the window's language, such as "700 times the last answer".
  std::string shown;
  std::string stored;  ///< The same in the words that the study's log stores.
};

/// Returns the doubts about an answer; empty for an ordinary one.
[[nodiscard]] std::vector<AnswerDoubt> doubts_about(const GivenAnswer& given);

/// The doubts in one line, in the window's language: "no stroke in the test; ..."; "" for none.
[[nodiscard]] std::string shown_doubts(const std::vector<AnswerDoubt>& doubts);
/// The doubts in one line, in the words of the log.
[[nodiscard]] std::string stored_doubts(const std::vector<AnswerDoubt>& doubts);

/// The beginning of every note about a doubtful answer.
inline constexpr const char* kNoteOfDoubt = as_is("asked about the answer ");
/// Whether the program wrote this note about a doubtful answer, and no person did.
[[nodiscard]] bool is_note_of_doubt(std::string_view note) noexcept;

}  // namespace jnd::app
