#include "analysis/report/answer_words.h"

#include <gtest/gtest.h>

#include <cstring>

#include "analysis/words/said.h"

namespace jnd::analysis {
namespace answer_words_test {

const char* german(const char* english) {
  return std::strcmp(english, "yes") == 0 ? "ja" : english;
}

/// Speaks a language for the length of a test.
class AnswerWords : public ::testing::Test {
 protected:
  static void speak_german() { speak({.code = "de", .words = german, .decimal_comma = true}); }
  void TearDown() override { speak({}); }

  const QuestionnaireItem height_ = {
      .name = "body_height_m", .kind = "number", .question = "Wie groß?", .unit = "m"};
  const QuestionnaireItem hand_ = {.name = "handedness",
                                   .kind = "choice",
                                   .question = "Welche Hand?",
                                   .options = {"right", "not_said"},
                                   .option_labels = {"die rechte", "keine Angabe"}};
  const QuestionnaireItem solid_ = {
      .name = "solid_is_solid", .kind = "yes_no", .question = "Is it solid?"};
};

TEST_F(AnswerWords, ANameIsToldInWordsWithoutItsUnit) {
  EXPECT_EQ(item_words(height_), "body height");
  EXPECT_EQ(answer_words("1.80", height_), "1.8");
  EXPECT_EQ(answer_words("not_said", hand_), "not said");
}

TEST_F(AnswerWords, WhatIsAnsweredByYesOrNoIsToldAsItWasAsked) {
  EXPECT_EQ(item_words(solid_), "Is it solid?");
  EXPECT_EQ(answer_words("yes", solid_), "yes");
}

TEST_F(AnswerWords, InAnotherLanguageTheQuestionAndItsOptionsSpeak) {
  speak_german();
  EXPECT_EQ(item_words(height_), "Wie groß?");
  EXPECT_EQ(answer_words("1.80", height_), "1,8");
  EXPECT_EQ(answer_words("not_said", hand_), "keine Angabe");
  EXPECT_EQ(answer_words("of an older study", hand_), "of an older study");
  EXPECT_EQ(answer_words("yes", solid_), "ja");
}

}  // namespace answer_words_test
}  // namespace jnd::analysis
