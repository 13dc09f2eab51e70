#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/operator/session_view.h"

namespace jnd::app {

/// The words that the program itself shows on the participant's screen; studies bring the rest.
enum class ParticipantWord {
  kPause,
  kWait,
  kThanks,
  kRight,
  kWrong,
  kTooLate,
  kRead,
  kAgree,
  kBreakIsOver,
  kYouSaid,
  kPress,  ///< "press {}"
  kPage,   ///< "Page {} of {}"
  kYes,
  kNo,
  kFirst,
  kSecond,
  kThird,
  kDifferent,
  kSame,
  kCannotTell,
  kMatches,
  kLower,
  kRaise,
  kGoOn,
};

/// The words in the session's language, such as "de"; in English if the program lacks that
/// language.
[[nodiscard]] std::string participant_word(ParticipantWord word, const std::string& language);

/// Everything that may appear on the participant's screen. The screen is drawn from this alone,
/// so what is not in here cannot be seen on it: no level, no name of a block or a condition, no
/// force, no hint about an answer.
struct ParticipantScreen {
  HandSign sign = HandSign::kNone;
  /// An instruction, a question, or what to wait for.
  std::string text;
  std::vector<std::string> paragraphs;  ///< The text of a consent.
  /// "You agree to this:", and the sentence that is agreed to.
  std::string agree, agreement;
  /// A possible answer, and which of the participant's controls gives it ("press FootSwitch:
  /// B"); "" if none does.
  struct Choice {
    std::string label, control;
  };
  std::vector<Choice> choices;
  int num_steps = 0;  ///< The steps of a scale; 0 for none.
  std::string low_label, high_label;
  /// The range of a number that is asked for, such as "1 – 2.5 m".
  std::string range;
  /// The number that the participant said, as far as the experimenter has typed it, with its
  /// unit, and "You said" before it; both are "" if there is none.
  std::string you_said, said;
  std::string countdown;  ///< The rest of a break, such as "1:23"; "" for none.
  std::string page;       ///< "Page {} of {}", for a text of several pages.
  double done_ratio = 0.0;
};

/// `typed` is what the experimenter is typing as the answer; "" for nothing.
[[nodiscard]] ParticipantScreen participant_screen(const SessionView& view,
                                                   std::string_view typed);

}  // namespace jnd::app
