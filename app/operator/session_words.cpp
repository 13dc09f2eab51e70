#include "app/operator/session_words.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "experiments/study/media.h"

namespace jnd::app {
namespace {

using experiments::AnswerKind;

/// What the participant's screen says of itself; studies bring the rest.
enum class Own { kPause, kWait, kThanks, kRight, kWrong };

std::string own_words(Own what, const std::string& language) {
  static const std::map<std::string, std::array<const char*, 5>> kWords = {
      {"en",
       {"Pause. Rest your hand.", "One moment, please.", "Thank you!", "That was right.",
        "That was wrong."}},
      {"de",
       {"Pause. Ruhen Sie Ihre Hand aus.", "Einen Moment bitte.", "Vielen Dank!",
        "Das war richtig.", "Das war falsch."}},
  };
  const auto known = kWords.find(language);
  return (known == kWords.end() ? kWords.at("en")
                                : known->second)[static_cast<std::size_t>(what)];
}

/// The sentences of a trial for two people, and for one alone.
struct TrialSentences {
  const char *present_reference, *present_fluid, *resting;
  const char *reference, *free_space, *production, *estimation, *number, *comparison;
  const char *present_first, *first, *second;
};
constexpr TrialSentences kForTwo = {
    "Show the fist, then present the reference.",
    "Show one finger, then present the fluid.",
    "The hand rests in free space.",
    "When the participant is ready, show one finger and present the test.",
    "Go back to a fluid when the participant is ready.",
    "Follow the participant's signs until it matches.",
    "At the ready sign, ask; type the percent and press Enter.",
    "At the ready sign, ask; type the number and press Enter.",
    "Show one finger. At the ready sign, ask:",
    "Show one finger, then present the first.",
    "When the participant is ready, show two fingers and present the second.",
    "Show two fingers. At the ready sign, ask:"};
constexpr TrialSentences kForOne = {"Present the reference.",
                                    "Present the fluid.",
                                    "A moment of free space.",
                                    "Feel the reference, then present the test.",
                                    "Go back to a fluid when you are ready.",
                                    "Lower or raise it until it feels right.",
                                    "Feel it, type the percent and press Enter.",
                                    "Feel it, type the number and press Enter.",
                                    "Feel the test, then answer:",
                                    "Present the first.",
                                    "Feel the first, then present the second.",
                                    "Feel the second, then answer:"};

/// What is told of the answer before, in front of what is said anyway.
void add_feedback(SessionView& view) {
  const std::string told =
      own_words(*view.feedback_right ? Own::kRight : Own::kWrong, view.language);
  view.say = told + (view.say.empty() ? "" : " " + view.say);
  view.participant_text =
      told + (view.participant_text.empty() ? "" : "\n" + view.participant_text);
}

/// What is said of a fluid, said of a solid surface.
void speak_of_a_surface(std::string& words) {
  const std::string fluid = "fluid";
  const std::size_t at = words.find(fluid);
  if (at != std::string::npos) words.replace(at, fluid.size(), "surface");
}

void add_trial_words(SessionView& view, std::string_view instruction) {
  const TrialView& trial = *view.trial;
  const TrialSentences& sentences = view.is_alone ? kForOne : kForTwo;
  const bool first = trial.in_block == 1;
  const std::string target =
      trial.target_percent
          ? "It should feel like " + number_words(*trial.target_percent) + " %."
          : "";
  if (view.step == Step::kRest || view.step == Step::kReady) {
    view.heading = view.step == Step::kRest ? "Free space" : "Next trial";
    view.say = first ? std::string(instruction) : target;
    view.participant_text = view.say;
    if (view.feedback_right) add_feedback(view);
    if (trial.order_is_drawn) {
      view.sentence = sentences.present_first;
      view.sign = HandSign::kOneFinger;
    } else if (trial.has_reference) {
      view.sentence = sentences.present_reference;
      view.sign = HandSign::kFist;
    } else {
      view.sentence = sentences.present_fluid;
      view.sign = HandSign::kOneFinger;
    }
    if (view.step == Step::kRest) {
      view.sentence = sentences.resting;
      view.sign = HandSign::kOpenHand;
    }
    return;
  }
  view.participant_text = trial.question;
  if (trial.interval == "reference") {
    view.heading = "Reference";
    view.sign = HandSign::kFist;
    view.sentence = sentences.reference;
    view.participant_text.clear();
    if (trial.modulus_value) {
      view.participant_text = "= " + number_words(*trial.modulus_value);
      view.say = view.participant_text;
    }
  } else if (trial.interval == "first") {
    view.heading = "First interval";
    view.sign = HandSign::kOneFinger;
    view.sentence = sentences.first;
    view.participant_text.clear();
  } else if (trial.interval == "second") {
    view.heading = "Second interval";
    view.sign = HandSign::kTwoFingers;
    view.sentence = sentences.second;
    view.say = trial.question;
  } else if (trial.interval == "free_space") {
    view.heading = "Free space";
    view.sign = HandSign::kOpenHand;
    view.sentence = sentences.free_space;
  } else if (trial.adjustable) {
    view.heading = "Test fluid";
    view.sign = HandSign::kOneFinger;
    view.sentence = sentences.production;
    view.say = target;
    view.participant_text = trial.question + (target.empty() ? "" : "\n" + target);
  } else {
    view.heading = "Test fluid";
    view.sign = HandSign::kOneFinger;
    view.sentence = trial.answer == AnswerKind::kPercent  ? sentences.estimation
                    : trial.answer == AnswerKind::kNumber ? sentences.number
                                                          : sentences.comparison;
    view.say = trial.question;
  }
}

void add_item_words(SessionView& view) {
  const ItemView& item = *view.item;
  view.sentence = item.text;
  view.say = item.say;
  if (item.kind == ItemView::Kind::kConsent) {
    view.sentence = "Let the participant read this and agree.";
  } else if (item.kind != ItemView::Kind::kTick) {
    view.participant_text = item.text;
  }
}

void add_begin_words(SessionView& view) {
  view.heading = view.last_sequence > 0 ? "Interrupted" : "Ready to begin";
  view.sentence = view.last_sequence > 0 ? "Choose how the session goes on."
                  : view.is_alone
                      ? "Feel virtual fluids with the mouse: they hold your hand back."
                      : "The loop runs and renders free space. Begin when you are ready.";
}

void add_medium_words(SessionView& view, std::string_view instruction) {
  const MediumView& medium = *view.medium;
  view.participant_text = std::string(instruction);
  view.say = medium.say.empty() && medium.index == 1 ? std::string(instruction) : medium.say;
  view.sentence = view.step == Step::kMedium ? "Present " + medium.name + "."
                  : view.is_alone ? "Feel " + medium.name + ": move the mouse to and fro."
                                  : "The participant feels " + medium.name + ".";
  view.sign = HandSign::kOpenHand;
}

std::string paused_words(const SessionView& view) {
  if (!view.loose_points.empty()) {
    return "Came off: " + view.loose_points +
           ". Put it back on the hand, then go on; what was felt is repeated.";
  }
  if (!view.came_off_points.empty()) {
    return "Came off and holds again: " + view.came_off_points +
           ". Go on when the participant is ready; what was felt is repeated.";
  }
  return "The hand is in free space. Go on when the participant is ready.";
}

}  // namespace

std::string number_words(double value) {
  if (!std::isfinite(value)) return "not a number";
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) >= 1000.0 ? "%.0f" : "%.3g", value);
  return text;
}

std::string level_words(const std::string& quantity, double intensity) {
  if (quantity == "scale") return "scale " + number_words(intensity);
  const std::string unit = experiments::quantity_unit(quantity);
  return number_words(intensity) + (unit.empty() ? "" : ' ' + unit);
}

std::string answer_words(AnswerKind kind, double answer) {
  if (kind == AnswerKind::kYesNo) return answer == 1.0 ? "yes" : "no";
  if (kind == AnswerKind::kInterval) return answer == 1.0 ? "first" : "second";
  return number_words(answer) + (kind == AnswerKind::kPercent ? " %" : "");
}

void add_words(SessionView& view, std::string_view stage_title, std::string_view instruction) {
  view.heading = std::string(stage_title);
  view.participant_text = own_words(Own::kWait, view.language);
  switch (view.step) {
    case Step::kBegin:
      return add_begin_words(view);
    case Step::kItem:
      return add_item_words(view);
    case Step::kMedium:
    case Step::kFeeling:
      add_medium_words(view, instruction);
      if (view.item) {
        view.sentence = view.item->text;
        view.participant_text = view.item->text;
      }
      return;
    case Step::kBreak:
      view.sentence = view.break_left_s > 0.0 ? "Rest." : "The rest is over. Go on when ready.";
      view.say = std::string(instruction);
      view.participant_text = std::string(instruction);
      return;
    case Step::kRest:
    case Step::kReady:
    case Step::kPresenting:
      add_trial_words(view, instruction);
      if (view.trial->is_solid) {
        speak_of_a_surface(view.heading);
        speak_of_a_surface(view.sentence);
      }
      return;
    case Step::kStageDone:
      view.sentence = "Done. Go on, or take the last answer back first.";
      if (!view.practice.empty()) view.sentence = "Done: " + view.practice + ". Go on?";
      if (view.feedback_right) add_feedback(view);
      return;
    case Step::kPaused:
      view.heading = "Paused";
      view.sentence = paused_words(view);
      view.participant_text = own_words(Own::kPause, view.language);
      return;
    case Step::kFault:
      view.heading = view.stop_pressed ? "Emergency stop" : "No force";
      view.sentence = view.fault;
      view.participant_text = own_words(Own::kPause, view.language);
      return;
    case Step::kFailed:
      view.heading = "Stopped";
      view.sentence = view.fault;
      view.participant_text = own_words(Own::kPause, view.language);
      return;
    case Step::kFinished:
      view.heading = "Finished";
      view.sentence = "The session is over; every answer is on disk.";
      view.participant_text = own_words(Own::kThanks, view.language);
      return;
  }
}

}  // namespace jnd::app
