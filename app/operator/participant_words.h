#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/operator/session_view.h"

namespace jnd::app {

/// What the participant's screen says of itself; studies bring the rest.
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

/// In the language of the session ("de"); in English where the program has no words of it.
[[nodiscard]] std::string participant_word(ParticipantWord word, const std::string& language);

/// Everything that may stand on the participant's screen. The screen is drawn from this and
/// from nothing else, so what is not in here cannot be seen on it: no level, no name of a block
/// or a condition, no force, no hint about an answer.
struct ParticipantScreen {
  HandSign sign = HandSign::kNone;
  std::string text;                     ///< Instruction, question, or what to wait for.
  std::vector<std::string> paragraphs;  ///< Of a consent.
  std::string agree, agreement;  ///< "You agree to this:", and the sentence that is agreed to.
  /// What can be answered, and which control of theirs does it ("press FootSwitch: B"); "" for
  /// none.
  struct Choice {
    std::string label, control;
  };
  std::vector<Choice> choices;
  int num_steps = 0;  ///< Of a scale; 0 for none.
  std::string low_label, high_label;
  std::string range;  ///< Of a number that is asked for: "1 – 2.5 m".
  /// The number that they said, as far as the experimenter has typed it, with its unit, and
  /// "You said" before it; both "" for none.
  std::string you_said, said;
  std::string countdown;  ///< Of a break: "1:23"; "" for none.
  std::string page;       ///< "Page {} of {}", for what has more than one.
  double done_ratio = 0.0;
};

/// `typed`: what the experimenter is typing as the answer; "" for nothing.
[[nodiscard]] ParticipantScreen participant_screen(const SessionView& view,
                                                   std::string_view typed);

}  // namespace jnd::app
