#include "app/operator/participant_words.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/operator/session_words.h"
#include "support/places.h"

namespace jnd::app {
namespace participant_words_test {

using experiments::AnswerKind;
using Labels = std::vector<std::pair<std::string, std::string>>;

Labels labels_of(const ParticipantScreen& screen) {
  Labels labels;
  for (const auto& choice : screen.choices) labels.emplace_back(choice.label, choice.control);
  return labels;
}

/// Returns a view in which the test of a trial is being felt, with everything about it.
SessionView trial_of(AnswerKind kind, const std::string& language = "en") {
  SessionView view{.language = language, .step = Step::kPresenting};
  view.trial = TrialView{.answer = kind,
                         .interval = "test",
                         .can_answer = true,
                         .question = "How thick?",
                         .yes_label = "Yes",
                         .no_label = "No",
                         .level = "1.65 Pa s"};
  add_words(view, "Block of honey", "Say how thick.");
  return view;
}

SessionView item_of(ItemView item, const std::string& language = "en") {
  SessionView view{.language = language, .step = Step::kItem, .item = std::move(item)};
  add_words(view, "Questions", "");
  return view;
}

TEST(ParticipantWords, EveryLanguageOfTheWindowHasThemToo) {
  int num_languages = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test_support::source_folder() / "data/languages")) {
    if (entry.path().extension() != ".po") continue;
    const std::string language = entry.path().stem();
    EXPECT_NE(participant_word(ParticipantWord::kThanks, language), "Thank you!") << language;
    ++num_languages;
  }
  EXPECT_GT(num_languages, 0);
  EXPECT_EQ(participant_word(ParticipantWord::kThanks, "en"), "Thank you!");
  EXPECT_EQ(participant_word(ParticipantWord::kThanks, "none of them"), "Thank you!");
}

TEST(ParticipantWords, AConsentHasItsTextAndWhatIsAgreedTo) {
  const ParticipantScreen screen = participant_screen(
      item_of({.kind = ItemView::Kind::kConsent,
               .text = "Ich nehme teil.",
               .paragraphs = {"Sie fühlen Flüssigkeiten.", "Sie können jederzeit aufhören."}},
              "de"),
      "");
  EXPECT_EQ(screen.paragraphs.size(), 2U);
  EXPECT_EQ(screen.agreement, "Ich nehme teil.");
  EXPECT_EQ(screen.agree, "Sie stimmen diesem Satz zu:");
  EXPECT_EQ(screen.text, "Bitte lesen Sie dies, und fragen Sie alles, was Sie wissen möchten.");
}

TEST(ParticipantWords, AChecklistIsNotTheParticipants) {
  const ParticipantScreen screen = participant_screen(
      item_of({.kind = ItemView::Kind::kTick, .text = "Power on.", .say = "Hello."}), "done");
  EXPECT_EQ(screen.text, "One moment, please.");
  EXPECT_TRUE(screen.choices.empty());
  EXPECT_EQ(screen.said, "");
}

TEST(ParticipantWords, WhatTheySaidStandsThereWithItsUnit) {
  const auto said = [](const SessionView& view, const char* typed) {
    return participant_screen(view, typed).said;
  };
  EXPECT_EQ(said(trial_of(AnswerKind::kPercent), "120"), "120 %");
  EXPECT_EQ(said(trial_of(AnswerKind::kPercent), ""), "");
  EXPECT_EQ(said(trial_of(AnswerKind::kNumber), "7.5"), "7.5");
  EXPECT_EQ(said(trial_of(AnswerKind::kYesNo), "7"), "") << "no number is asked for";
  const SessionView height = item_of({.kind = ItemView::Kind::kNumber,
                                      .text = "Height?",
                                      .unit = "m",
                                      .minimum = 1,
                                      .maximum = 2.5});
  EXPECT_EQ(said(height, "1.8"), "1.8 m");
  EXPECT_EQ(participant_screen(height, "1.8").you_said, "You said");
  EXPECT_EQ(participant_screen(height, "").range, "1 – 2.5 m");
  SessionView before = trial_of(AnswerKind::kPercent);
  before.trial->can_answer = false;
  EXPECT_EQ(said(before, "120"), "") << "nothing can be answered yet";
}

TEST(ParticipantWords, ABreakCountsDown) {
  SessionView view{.language = "en", .step = Step::kBreak, .break_left_s = 82.3, .break_s = 90};
  add_words(view, "Break", "Rest your hand.");
  ParticipantScreen screen = participant_screen(view, "");
  EXPECT_EQ(screen.text, "Rest your hand.");
  EXPECT_EQ(screen.countdown, "1:23");
  view.break_left_s = 0.2;
  EXPECT_EQ(participant_screen(view, "").countdown, "0:01");
  view.break_left_s = 0;
  screen = participant_screen(view, "");
  EXPECT_EQ(screen.countdown, "");
  EXPECT_EQ(screen.text, "The break is over.\nOne moment, please.");
}

TEST(ParticipantWords, AScaleHasItsStepsAndEnds) {
  SessionView view = trial_of(AnswerKind::kStep);
  view.trial->num_steps = 7;
  view.trial->low_label = "thin";
  view.trial->high_label = "thick";
  ParticipantScreen screen = participant_screen(view, "");
  EXPECT_EQ(screen.num_steps, 7);
  EXPECT_EQ(screen.low_label + screen.high_label, "thinthick");
  EXPECT_TRUE(screen.choices.empty());
  view.participant_answers = true;
  view.controls = {{"step_1", "Box: 1"}, {"step_7", "Box: 7"}, {"step_8", "Box: 8"}};
  EXPECT_EQ(labels_of(participant_screen(view, "")),
            (Labels{{"1", "press Box: 1"}, {"7", "press Box: 7"}}));
}

TEST(ParticipantWords, PedalsMeanSomethingOnlyWhereTheParticipantAnswers) {
  SessionView view = trial_of(AnswerKind::kYesNo, "de");
  view.controls = {{"first", "Pedal: A"}, {"no", "Pedal: B"}, {"present", "Pedal: C"}};
  EXPECT_EQ(labels_of(participant_screen(view, "")), (Labels{{"Ja", ""}, {"Nein", ""}}));
  view.participant_answers = true;
  EXPECT_EQ(labels_of(participant_screen(view, "")),
            (Labels{{"Ja", "Pedal: A drücken"}, {"Nein", "Pedal: B drücken"}}));
  view.trial->can_answer = false;
  EXPECT_EQ(labels_of(participant_screen(view, "")), (Labels{{"Weiter", "Pedal: C drücken"}}));
  view.trial->least_left_s = 2;
  EXPECT_TRUE(participant_screen(view, "").choices.empty()) << "not yet";
  view = trial_of(AnswerKind::kMatch);
  view.participant_answers = true;
  view.controls = {{"raise_fine", "Box: 2"}, {"matches", "Box: 3"}};
  EXPECT_EQ(labels_of(participant_screen(view, "")),
            (Labels{{"Raise", "press Box: 2"}, {"Matches", "press Box: 3"}}));
}

TEST(ParticipantWords, WordsOfTheStudyAreKept) {
  SessionView view = trial_of(AnswerKind::kYesNo, "de");
  view.trial->yes_label = "Zäher";
  view.trial->no_label = "Nicht zäher";
  view.trial->takes_cannot_tell = true;
  EXPECT_EQ(labels_of(participant_screen(view, "")),
            (Labels{{"Zäher", ""}, {"Nicht zäher", ""}, {"Nicht zu sagen", ""}}));
}

TEST(ParticipantWords, ThereIsAlwaysSomethingToReadOrASign) {
  SessionView view{.language = "fr"};
  for (int step = 0; step <= static_cast<int>(Step::kFinished); ++step) {
    view.step = static_cast<Step>(step);
    if (view.step == Step::kItem || view.step == Step::kMedium || view.step == Step::kFeeling ||
        view.step == Step::kRest || view.step == Step::kReady ||
        view.step == Step::kPresenting) {
      continue;
    }
    view.participant_text.clear();
    add_words(view, "Block of honey", "");
    const ParticipantScreen screen = participant_screen(view, "");
    EXPECT_FALSE(screen.text.empty()) << step;
  }
}

}  // namespace participant_words_test
}  // namespace jnd::app
