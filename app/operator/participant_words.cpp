#include "app/operator/participant_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <iterator>
#include <map>
#include <utility>

#include "app/language/words.h"
#include "app/operator/session_words.h"

namespace jnd::app {
namespace {

using experiments::AnswerKind;
using Word = ParticipantWord;

constexpr std::size_t kNumParticipantWords = static_cast<std::size_t>(Word::kGoOn) + 1;
using ParticipantWords = std::array<const char*, kNumParticipantWords>;

// The words are in the order of `ParticipantWord`.
constexpr ParticipantWords kInEnglish = {
    as_is("Pause. Rest your hand."),
    as_is("One moment, please."),
    as_is("Thank you!"),
    as_is("That was right."),
    as_is("That was wrong."),
    as_is("The time to answer was over. The trial comes again."),
    as_is("Please read this, and ask whatever you want to know."),
    as_is("You agree to this:"),
    as_is("The break is over."),
    as_is("You said"),
    as_is("press {}"),
    as_is("Page {} of {}"),
    as_is("Yes"),
    as_is("No"),
    as_is("First"),
    as_is("Second"),
    as_is("Third"),
    as_is("Different"),
    as_is("Same"),
    as_is("Cannot tell"),
    as_is("Matches"),
    as_is("Lower"),
    as_is("Raise"),
    as_is("Go on"),
};
constexpr ParticipantWords kInGerman = {
    as_is("Pause. Ruhen Sie Ihre Hand aus."),
    as_is("Einen Moment bitte."),
    as_is("Vielen Dank!"),
    as_is("Das war richtig."),
    as_is("Das war falsch."),
    as_is("Die Zeit für die Antwort war um. Der Durchgang kommt noch einmal."),
    as_is("Bitte lesen Sie dies, und fragen Sie alles, was Sie wissen möchten."),
    as_is("Sie stimmen diesem Satz zu:"),
    as_is("Die Pause ist vorbei."),
    as_is("Sie sagten"),
    as_is("{} drücken"),
    as_is("Seite {} von {}"),
    as_is("Ja"),
    as_is("Nein"),
    as_is("Erster"),
    as_is("Zweiter"),
    as_is("Dritter"),
    as_is("Verschieden"),
    as_is("Gleich"),
    as_is("Nicht zu sagen"),
    as_is("Passt"),
    as_is("Schwächer"),
    as_is("Stärker"),
    as_is("Weiter"),
};

/// The languages that the program has words in. Everyone else reads English.
struct LanguageOfParticipants {
  const char* code;
  const ParticipantWords& words;
};
constexpr LanguageOfParticipants kLanguagesOfParticipants[] = {{"de", kInGerman}};

/// Minutes and seconds, such as "1:23"; a second that has begun counts.
std::string countdown_words(double seconds) {
  const long whole = std::lround(std::ceil(std::clamp(seconds, 0.0, 359999.0)));
  char text[32];
  std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  return text;
}

std::string range_of(const ItemView& item) {
  std::string range;
  if (item.minimum && item.maximum) {
    range = number_words(*item.minimum) + " – " + number_words(*item.maximum);
  } else if (item.minimum) {
    range = "≥ " + number_words(*item.minimum);
  } else if (item.maximum) {
    range = "≤ " + number_words(*item.maximum);
  }
  return range.empty() || item.unit.empty() ? range + item.unit : range + " " + item.unit;
}

class ScreenWriter {
 public:
  ScreenWriter(const SessionView& view, std::string_view typed) : view_(view), typed_(typed) {}

  ParticipantScreen written() {
    screen_.sign = view_.sign;
    screen_.text = view_.participant_text;
    screen_.done_ratio = view_.done_ratio;
    screen_.page = word(Word::kPage);
    if (view_.step == Step::kBreak) add_break();
    const bool asks_item = view_.step == Step::kItem || view_.step == Step::kFeeling ||
                           view_.step == Step::kMedium;
    if (asks_item && view_.item) add_item(*view_.item);
    const bool in_trial = view_.step == Step::kReady || view_.step == Step::kPresenting;
    if (in_trial && view_.trial) add_trial(*view_.trial);
    const bool is_empty = screen_.sign == HandSign::kNone && screen_.text.empty() &&
                          screen_.paragraphs.empty() && screen_.choices.empty();
    if (is_empty) screen_.text = word(Word::kWait);
    return std::move(screen_);
  }

 private:
  [[nodiscard]] std::string word(Word which) const {
    return participant_word(which, view_.language);
  }
  /// If the study has no words for a label, it is in the window's language and has to be
  /// replaced.
  [[nodiscard]] std::string label_of(
      const std::string& label,
      std::initializer_list<std::pair<const char*, Word>> words_of_the_window) const {
    for (const auto& [in_window, own] : words_of_the_window) {
      if (label == in_window) return word(own);
    }
    return label;
  }
  void add(const std::string& label, std::initializer_list<std::string_view> actions,
           bool needs_control = false) {
    std::string press;
    for (const std::string_view action : actions) {
      const auto control = view_.controls.find(std::string(action));
      if (!view_.participant_answers || control == view_.controls.end()) continue;
      press = fmt::format(fmt::runtime(word(Word::kPress)), control->second);
      break;
    }
    if (needs_control && press.empty()) return;
    screen_.choices.push_back({label, press});
  }
  void add_said(const std::string& unit) {
    if (typed_.empty()) return;
    screen_.you_said = word(Word::kYouSaid);
    screen_.said = std::string(typed_) + (unit.empty() ? "" : " " + unit);
  }

  void add_break() {
    if (view_.break_left_s > 0.0) {
      screen_.countdown = countdown_words(view_.break_left_s);
    } else {
      screen_.text = word(Word::kBreakIsOver) + "\n" + word(Word::kWait);
    }
  }

  void add_item(const ItemView& item) {
    using Kind = ItemView::Kind;
    switch (item.kind) {
      case Kind::kTick:
      case Kind::kText:
      case Kind::kWords:
        return;
      case Kind::kConsent:
        screen_.text = word(Word::kRead);
        screen_.paragraphs = item.paragraphs;
        screen_.agree = word(Word::kAgree);
        screen_.agreement = item.text;
        return;
      case Kind::kNumber:
        screen_.range = range_of(item);
        return add_said(item.unit);
      case Kind::kChoice:
        for (const ItemView::Option& option : item.options) {
          screen_.choices.push_back({option.label, ""});
        }
        return;
      case Kind::kYesNo:
      case Kind::kYesNoWhich:
        screen_.choices = {{word(Word::kYes), ""}, {word(Word::kNo), ""}};
        return;
      case Kind::kScale:
        screen_.num_steps = item.num_steps;
        screen_.low_label = item.low_label;
        screen_.high_label = item.high_label;
        return;
    }
  }

  void add_trial(const TrialView& trial) {
    if (view_.step == Step::kPresenting && trial.can_answer) add_answers(trial);
    const bool can_present =
        view_.step == Step::kReady || (!trial.can_answer && trial.least_left_s <= 0.0);
    if (can_present) add(word(Word::kGoOn), {"present"}, /*needs_control=*/true);
  }

  void add_answers(const TrialView& trial) {
    switch (trial.answer) {
      case AnswerKind::kYesNo:
        add(label_of(trial.yes_label, {{tr("Yes"), Word::kYes},
                                       {tr("First"), Word::kFirst},
                                       {tr("Different"), Word::kDifferent}}),
            {"yes", "first"});
        add(label_of(trial.no_label, {{tr("No"), Word::kNo},
                                      {tr("Second"), Word::kSecond},
                                      {tr("Same"), Word::kSame}}),
            {"no", "second"});
        break;
      case AnswerKind::kInterval:
        for (const TrialView::Choice& choice : trial.choices) {
          constexpr std::string_view kActions[] = {"first", "second", "third"};
          add(label_of(choice.label, {{tr("First"), Word::kFirst},
                                      {tr("Second"), Word::kSecond},
                                      {tr("Third"), Word::kThird}}),
              {kActions[std::clamp(choice.interval, 1, 3) - 1]});
        }
        break;
      case AnswerKind::kStep:
        screen_.num_steps = trial.num_steps;
        screen_.low_label = trial.low_label;
        screen_.high_label = trial.high_label;
        for (int step = 1; step <= trial.num_steps; ++step) {
          const std::string number = std::to_string(step);
          add(number, {"step_" + number}, /*needs_control=*/true);
        }
        break;
      case AnswerKind::kMatch:
        add(word(Word::kLower), {"lower", "lower_fine"}, /*needs_control=*/true);
        add(word(Word::kRaise), {"raise", "raise_fine"}, /*needs_control=*/true);
        add(word(Word::kMatches), {"matches"}, /*needs_control=*/true);
        break;
      case AnswerKind::kPercent:
        add_said("%");
        break;
      case AnswerKind::kNumber:
        add_said("");
        break;
    }
    if (trial.takes_cannot_tell) add(word(Word::kCannotTell), {"cannot_tell"});
  }

  const SessionView& view_;
  std::string_view typed_;
  ParticipantScreen screen_;
};

}  // namespace

std::string participant_word(ParticipantWord word, const std::string& language) {
  const auto* const found =
      std::ranges::find(kLanguagesOfParticipants, language, &LanguageOfParticipants::code);
  const bool is_known = found != std::end(kLanguagesOfParticipants);
  return (is_known ? found->words : kInEnglish)[static_cast<std::size_t>(word)];
}

ParticipantScreen participant_screen(const SessionView& view, std::string_view typed) {
  return ScreenWriter(view, typed).written();
}

}  // namespace jnd::app
