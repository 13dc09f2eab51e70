#include "app/operator/session_words.h"

#include <cmath>
#include <cstdio>
#include <vector>

#include "app/language/words.h"
#include "app/operator/participant_words.h"
#include "app/session/attachment_watch.h"
#include "experiments/study/media.h"

namespace jnd::app {
namespace {

using experiments::AnswerKind;

std::string own_words(ParticipantWord word, const SessionView& view) {
  return participant_word(word, view.language);
}

/// The sentences of a trial, for two people or for one alone.
struct TrialSentences {
  const char *present_reference, *present_fluid, *present_surface, *resting;
  const char *while_feeling_reference, *back_to_fluid, *back_to_surface, *production,
      *estimation, *number, *rating;
  const char *comparison, *present_first, *while_feeling_first, *while_feeling_second,
      *before_third, *while_feeling_third;
  const char *over_typed, *over_rating, *over_choice;
};
constexpr TrialSentences kForTwo = {
    .present_reference = tr_later("Show the fist, then present the reference."),
    .present_fluid = tr_later("Show one finger, then present the fluid."),
    .present_surface = tr_later("Show one finger, then present the surface."),
    .resting = tr_later("The hand rests in free space."),
    .while_feeling_reference =
        tr_later("When the participant is ready, show one finger and present the test."),
    .back_to_fluid = tr_later("Go back to a fluid when the participant is ready."),
    .back_to_surface = tr_later("Go back to a surface when the participant is ready."),
    .production = tr_later("Follow the participant's signs until it matches."),
    .estimation = tr_later("At the ready sign, ask; type the percent and press Enter."),
    .number = tr_later("At the ready sign, ask; type the number and press Enter."),
    .rating = tr_later("At the ready sign, ask for a step of the scale:"),
    .comparison = tr_later("Show one finger. At the ready sign, ask:"),
    .present_first = tr_later("Show one finger, then present the first."),
    .while_feeling_first =
        tr_later("When the participant is ready, show two fingers and present the second."),
    .while_feeling_second = tr_later("Show two fingers. At the ready sign, ask:"),
    .before_third =
        tr_later("When the participant is ready, show three fingers and present the third."),
    .while_feeling_third = tr_later("Show three fingers. At the ready sign, ask:"),
    .over_typed = tr_later("Ask; type the answer and press Enter."),
    .over_rating = tr_later("Ask for a step of the scale:"),
    .over_choice = tr_later("Ask:"),
};
/// The sentences for a participant who answers by a control, so that the experimenter does not
/// ask.
constexpr TrialSentences for_a_participant_who_answers() {
  TrialSentences sentences = kForTwo;
  sentences.comparison = tr_later("The participant answers:");
  sentences.while_feeling_second = sentences.comparison;
  sentences.while_feeling_third = sentences.comparison;
  sentences.rating = sentences.comparison;
  sentences.over_rating = sentences.comparison;
  sentences.over_choice = sentences.comparison;
  return sentences;
}
constexpr TrialSentences kForAnswering = for_a_participant_who_answers();
constexpr TrialSentences kForOne = {
    .present_reference = tr_later("Present the reference."),
    .present_fluid = tr_later("Present the fluid."),
    .present_surface = tr_later("Present the surface."),
    .resting = tr_later("A moment of free space."),
    .while_feeling_reference = tr_later("Feel the reference, then present the test."),
    .back_to_fluid = tr_later("Go back to a fluid when you are ready."),
    .back_to_surface = tr_later("Go back to a surface when you are ready."),
    .production = tr_later("Lower or raise it until it feels right."),
    .estimation = tr_later("Feel it, type the percent and press Enter."),
    .number = tr_later("Feel it, type the number and press Enter."),
    .rating = tr_later("Feel it, then choose a step:"),
    .comparison = tr_later("Feel the test, then answer:"),
    .present_first = tr_later("Present the first."),
    .while_feeling_first = tr_later("Feel the first, then present the second."),
    .while_feeling_second = tr_later("Feel the second, then answer:"),
    .before_third = tr_later("Feel the second, then present the third."),
    .while_feeling_third = tr_later("Feel the third, then answer:"),
    .over_typed = tr_later("Type your answer and press Enter."),
    .over_rating = tr_later("Choose a step:"),
    .over_choice = tr_later("Answer:"),
};

/// Puts what is told about the last answer in front of the other words.
void add_feedback(SessionView& view) {
  if (!view.feedback_right && !view.missed_deadline) return;
  const std::string told = own_words(view.missed_deadline   ? ParticipantWord::kTooLate
                                     : *view.feedback_right ? ParticipantWord::kRight
                                                            : ParticipantWord::kWrong,
                                     view);
  view.say = told + (view.say.empty() ? "" : " " + view.say);
  view.participant_text =
      told + (view.participant_text.empty() ? "" : "\n" + view.participant_text);
}

/// Adds the words for a stimulus that has ended by itself: the question, or what has to be felt
/// first.
void add_words_of_over(SessionView& view, const TrialSentences& sentences) {
  const TrialView& trial = *view.trial;
  view.heading = tr("The stimulus is over");
  view.sign = HandSign::kOpenHand;
  if (!trial.can_answer) {
    view.sentence = tr(trial.next_interval == "second"  ? sentences.while_feeling_first
                       : trial.next_interval == "third" ? sentences.before_third
                                                        : sentences.while_feeling_reference);
    view.participant_text.clear();
    return;
  }
  if (trial.adjustable) {
    view.sentence = tr(trial.is_solid ? sentences.back_to_surface : sentences.back_to_fluid);
    return;
  }
  view.sentence =
      tr(trial.answer == AnswerKind::kStep ? sentences.over_rating
         : trial.answer == AnswerKind::kPercent || trial.answer == AnswerKind::kNumber
             ? sentences.over_typed
             : sentences.over_choice);
  view.say = trial.question;
}

void add_trial_words(SessionView& view, std::string_view instruction) {
  const TrialView& trial = *view.trial;
  const TrialSentences& sentences = view.is_alone              ? kForOne
                                    : view.participant_answers ? kForAnswering
                                                               : kForTwo;
  const bool first = trial.in_block == 1;
  const std::string target = trial.target_percent ? tr("It should feel like {} %.",
                                                       number_words(*trial.target_percent))
                                                  : "";
  if (view.step == Step::kRest || view.step == Step::kReady) {
    view.heading = view.step == Step::kRest ? tr("Free space") : tr("Next trial");
    view.say = first ? std::string(instruction) : target;
    view.participant_text = view.say;
    add_feedback(view);
    if (trial.order_is_drawn) {
      view.sentence = tr(sentences.present_first);
      view.sign = HandSign::kOneFinger;
    } else if (trial.has_reference) {
      view.sentence = tr(sentences.present_reference);
      view.sign = HandSign::kFist;
    } else {
      view.sentence = tr(trial.is_solid ? sentences.present_surface : sentences.present_fluid);
      view.sign = HandSign::kOneFinger;
    }
    if (view.step == Step::kRest) {
      view.sentence = tr(sentences.resting);
      view.sign = HandSign::kOpenHand;
    }
    return;
  }
  view.participant_text = trial.question;
  if (trial.interval == "reference") {
    view.heading = tr("Reference");
    view.sign = HandSign::kFist;
    view.sentence = tr(sentences.while_feeling_reference);
    view.participant_text.clear();
    if (trial.modulus_value) {
      view.participant_text = "= " + number_words(*trial.modulus_value);
      view.say = view.participant_text;
    }
  } else if (trial.interval == "first") {
    view.heading = tr("First interval");
    view.sign = HandSign::kOneFinger;
    view.sentence = tr(sentences.while_feeling_first);
    view.participant_text.clear();
  } else if (trial.interval == "second") {
    view.heading = tr("Second interval");
    view.sign = HandSign::kTwoFingers;
    const bool is_last = trial.num_intervals == 2 || trial.can_answer;
    view.sentence = tr(is_last ? sentences.while_feeling_second : sentences.before_third);
    if (is_last) {
      view.say = trial.question;
    } else {
      view.participant_text.clear();
    }
  } else if (trial.interval == "third") {
    view.heading = tr("Third interval");
    view.sign = HandSign::kThreeFingers;
    view.sentence = tr(sentences.while_feeling_third);
    view.say = trial.question;
  } else if (trial.stimulus_is_over) {
    add_words_of_over(view, sentences);
  } else if (trial.interval == "free_space") {
    view.heading = tr("Free space");
    view.sign = HandSign::kOpenHand;
    view.sentence = tr(trial.is_solid ? sentences.back_to_surface : sentences.back_to_fluid);
  } else if (trial.adjustable) {
    view.heading = trial.is_solid ? tr("Test surface") : tr("Test fluid");
    view.sign = HandSign::kOneFinger;
    view.sentence = tr(sentences.production);
    view.say = target;
    view.participant_text = trial.question + (target.empty() ? "" : "\n" + target);
  } else {
    view.heading = trial.is_solid ? tr("Test surface") : tr("Test fluid");
    view.sign = HandSign::kOneFinger;
    view.sentence = tr(trial.answer == AnswerKind::kPercent  ? sentences.estimation
                       : trial.answer == AnswerKind::kNumber ? sentences.number
                       : trial.answer == AnswerKind::kStep   ? sentences.rating
                                                             : sentences.comparison);
    view.say = trial.question;
  }
}

void add_item_words(SessionView& view) {
  const ItemView& item = *view.item;
  view.sentence = item.text;
  if (item.trial != 0) view.heading = tr("Question {} of {}", item.index, item.count);
  view.say = item.say;
  if (item.kind == ItemView::Kind::kConsent) {
    view.sentence = tr("Let the participant read this and agree.");
  } else if (item.kind != ItemView::Kind::kTick) {
    view.participant_text = item.text;
  }
}

void add_begin_words(SessionView& view) {
  view.heading = view.last_sequence > 0 ? tr("Interrupted") : tr("Ready to begin");
  view.sentence = view.last_sequence > 0 ? tr("Choose how the session goes on.")
                  : view.is_alone
                      ? tr("Feel virtual fluids with the mouse: they hold your hand back.")
                      : tr("The loop runs and renders free space. Begin when you are ready.");
}

void add_medium_words(SessionView& view, std::string_view instruction) {
  const MediumView& medium = *view.medium;
  view.participant_text = std::string(instruction);
  view.say = medium.say.empty() && medium.index == 1 ? std::string(instruction) : medium.say;
  view.sentence = view.step == Step::kMedium ? tr("Present {}.", medium.name)
                  : view.is_alone ? tr("Feel {}: move the mouse to and fro.", medium.name)
                                  : tr("The participant feels {}.", medium.name);
  view.sign = HandSign::kOpenHand;
}

std::string paused_words(const SessionView& view) {
  if (!view.loose_points.empty()) {
    return tr("Came off: {}. Put it back on the hand, then go on; what was felt is repeated.",
              view.loose_points);
  }
  if (!view.came_off_points.empty()) {
    return tr(
        "Came off and holds again: {}. Go on when the participant is ready; what was felt is "
        "repeated.",
        view.came_off_points);
  }
  return tr("The hand is in free space. Go on when the participant is ready.");
}

}  // namespace

std::string number_words(double value) {
  if (!std::isfinite(value)) return tr("not a number");
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) >= 1000.0 ? "%.0f" : "%.3g", value);
  return text;
}

std::string told_points(std::uint8_t bits) {
  const std::vector<std::string> points = names_of_points(bits);
  std::string words;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const char* point = tr(points[i].c_str());
    if (i == 0) {
      words = point;
    } else if (i + 1 < points.size()) {
      words += std::string(", ") + point;
    } else {
      words = tr("{} and {}", words, std::string(point));
    }
  }
  return words;
}

std::string level_words(const std::string& quantity, double intensity) {
  if (quantity == "scale") return tr("scale {}", number_words(intensity));
  const std::string unit = experiments::quantity_unit(quantity);
  return number_words(intensity) + (unit.empty() ? "" : ' ' + unit);
}

std::string answer_words(AnswerKind kind, double answer) {
  if (kind == AnswerKind::kYesNo) return answer == 1.0 ? tr("yes") : tr("no");
  if (kind == AnswerKind::kInterval) {
    return answer == 1.0 ? tr("first") : answer == 2.0 ? tr("second") : tr("third");
  }
  return number_words(answer) + (kind == AnswerKind::kPercent ? " %" : "");
}

void add_words(SessionView& view, std::string_view stage_title, std::string_view instruction) {
  view.heading = std::string(stage_title);
  view.participant_text = own_words(ParticipantWord::kWait, view);
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
      view.sentence =
          view.break_left_s > 0.0 ? tr("Rest.") : tr("The rest is over. Go on when ready.");
      view.say = std::string(instruction);
      view.participant_text = std::string(instruction);
      return;
    case Step::kRest:
    case Step::kReady:
    case Step::kPresenting:
      add_trial_words(view, instruction);
      return;
    case Step::kStageDone:
      view.sentence = tr("Done. Go on, or take the last answer back first.");
      if (!view.practice.empty()) view.sentence = tr("Done: {}. Go on?", view.practice);
      add_feedback(view);
      return;
    case Step::kPaused:
      view.heading = tr("Paused");
      view.sentence = paused_words(view);
      view.participant_text = own_words(ParticipantWord::kPause, view);
      return;
    case Step::kFault:
      view.heading = view.stop_pressed ? tr("Emergency stop") : tr("No force");
      view.sentence = view.fault;
      view.participant_text = own_words(ParticipantWord::kPause, view);
      return;
    case Step::kFailed:
      view.heading = tr("Stopped");
      view.sentence = view.fault;
      view.participant_text = own_words(ParticipantWord::kPause, view);
      return;
    case Step::kFinished:
      view.heading = tr("Finished");
      view.sentence = tr("The session is over; every answer is on disk.");
      view.participant_text = own_words(ParticipantWord::kThanks, view);
      return;
  }
}

}  // namespace jnd::app
