#include "app/operator/answer_doubts.h"

#include <gtest/gtest.h>

namespace jnd::app {
namespace answer_doubts_test {

using experiments::AnswerKind;

std::string doubted(const GivenAnswer& given) { return shown_doubts(doubts_about(given)); }

TEST(AnswerDoubts, AnAnswerLikeAnyOtherIsNotAskedAbout) {
  EXPECT_EQ(
      doubted(
          {.kind = AnswerKind::kPercent, .value = 250.0, .last_value = 40.0, .felt_s = 6.0}),
      "");
  EXPECT_EQ(doubted({.kind = AnswerKind::kYesNo, .value = 0.0, .felt_s = 0.6}), "");
  EXPECT_EQ(doubted({.kind = AnswerKind::kYesNo, .value = std::nullopt, .felt_s = 2.0}), "")
      << "cannot tell";
}

TEST(AnswerDoubts, AMistypedMagnitudeIs) {
  EXPECT_EQ(doubted({.kind = AnswerKind::kPercent, .value = 99999.0, .felt_s = 3.0}),
            "more than 1000 %");
  EXPECT_EQ(doubted({.kind = AnswerKind::kPercent, .value = 70000.0, .last_value = 100.0}),
            "more than 1000 %; 700 times the last answer");
  EXPECT_EQ(doubted({.kind = AnswerKind::kNumber, .value = 1.0, .last_value = 40.0}),
            "1/40 of the last answer");
  EXPECT_EQ(doubted({.kind = AnswerKind::kNumber, .value = 5000.0, .last_value = 400.0}), "")
      << "a number of one's own has no hundred percent";
  EXPECT_EQ(doubted({.kind = AnswerKind::kPercent, .value = 0.0, .last_value = 100.0}), "")
      << "nothing felt is an answer";
  EXPECT_EQ(doubted({.kind = AnswerKind::kStep, .value = 9.0, .last_value = 0.1}), "");
}

TEST(AnswerDoubts, SoIsOneThatNobodyCanHaveFeltFor) {
  EXPECT_EQ(doubted({.kind = AnswerKind::kYesNo, .value = 1.0, .felt_s = 0.3}),
            "0.3 s after the stimulus began");
  EXPECT_EQ(doubted({.kind = AnswerKind::kYesNo, .value = 1.0, .unstroked = {"reference"}}),
            "no stroke in the reference");
  EXPECT_EQ(
      doubted({.kind = AnswerKind::kInterval, .value = 1.0, .unstroked = {"first", "second"}}),
      "no stroke in the first; no stroke in the second");
}

TEST(AnswerDoubts, TheLogHasThemInEnglish) {
  EXPECT_EQ(stored_doubts(doubts_about({.kind = AnswerKind::kPercent,
                                        .value = 70000.0,
                                        .last_value = 100.0,
                                        .felt_s = 0.25,
                                        .unstroked = {"test"}})),
            "more than 1000 %; 700 times the last answer; 0.2 s after the stimulus began; no "
            "stroke in the test");
}

}  // namespace answer_doubts_test
}  // namespace jnd::app
