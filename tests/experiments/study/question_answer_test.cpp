#include "experiments/study/question_answer.h"

#include <gtest/gtest.h>

namespace jnd::experiments {
namespace question_answer_test {

QuestionnaireItem item_of(const std::string& kind) {
  QuestionnaireItem item;
  item.name = "q";
  item.kind = kind;
  item.num_steps = 5;
  item.options = {{"left", {}}, {"right", {}}};
  return item;
}

TEST(QuestionAnswers, OfAScaleAreItsSteps) {
  const QuestionnaireItem scale = item_of("scale");
  for (const char* step : {"1", "5", "5.0"})
    EXPECT_EQ(expected_answer(scale, step), "") << step;
  for (const char* other : {"0", "6", "2.5", "", "two", "3x"}) {
    EXPECT_EQ(expected_answer(scale, other), "a step from 1 to 5") << other;
  }
}

TEST(QuestionAnswers, OfANumberKeepToItsEnds) {
  QuestionnaireItem number = item_of("number");
  EXPECT_EQ(expected_answer(number, "-1e300"), "");
  number.minimum = 0.0;
  EXPECT_EQ(expected_answer(number, "-0.5"), "a number >= 0");
  number.maximum = 100.0;
  EXPECT_EQ(expected_answer(number, "100"), "");
  for (const char* other : {"100.5", "nan", "inf", "", "1,5"}) {
    EXPECT_EQ(expected_answer(number, other), "a number >= 0 and <= 100") << other;
  }
}

TEST(QuestionAnswers, AreAmongWhatIsOffered) {
  EXPECT_EQ(expected_answer(item_of("choice"), "left"), "");
  EXPECT_EQ(expected_answer(item_of("choice"), "up"), "`left` or `right`");
  EXPECT_EQ(expected_answer(item_of("yes_no"), "no"), "");
  EXPECT_EQ(expected_answer(item_of("yes_no"), "maybe"), "yes or no");
  EXPECT_EQ(expected_answer(item_of("yes_no_which"), "yes: a buzz"), "");
  EXPECT_EQ(expected_answer(item_of("yes_no_which"), "yes: "), "no, or yes and which");
  EXPECT_EQ(expected_answer(item_of("text"), "sticky"), "");
  EXPECT_EQ(expected_answer(item_of("text"), "  "), "words");
}

TEST(QuestionAnswers, CanBeLeftOutWhereTheyAreNotRequired) {
  QuestionnaireItem scale = item_of("scale");
  EXPECT_NE(expected_answer(scale, kNoAnswer), "");
  scale.required = false;
  EXPECT_EQ(expected_answer(scale, kNoAnswer), "");
}

}  // namespace question_answer_test
}  // namespace jnd::experiments
