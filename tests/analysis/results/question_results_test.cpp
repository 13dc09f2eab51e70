#include <gtest/gtest.h>

#include "analysis/found_results.h"
#include "analysis/hand_made_study.h"
#include "analysis/results/rated_answers.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace question_results_test {

constexpr char kProtocol[] = R"json({"name": "asked", "languages": ["en"], "stages": [
  {"kind": "block", "name": "pair", "procedure": "constant_stimuli", "medium": "viscous",
   "viscosity_pa_s": [4, 16], "reference_viscosity_pa_s": 8, "repetitions": 2,
   "questions": [
     {"name": "confidence", "kind": "scale", "num_steps": 6, "question": {"en": "How sure?"},
      "low_label": {"en": "guessed"}, "high_label": {"en": "sure"}},
     {"name": "feel", "kind": "choice", "question": {"en": "Like what?"},
      "options": [{"value": "oil"}, {"value": "honey"}]},
     {"name": "remark", "kind": "text", "required": false, "question": {"en": "Else?"}}]},
  {"kind": "block", "name": "rated", "procedure": "rating", "medium": "viscous",
   "viscosity_pa_s": [1, 2, 4], "repetitions": 1, "num_steps": 7,
   "low_label": {"en": "thin"}, "high_label": {"en": "thick"}}]})json";

class QuestionResultsTest : public ::testing::Test {
 protected:
  void pair(double intensity, double response, const std::string& confidence,
            const std::string& feel, const std::string& remark = "no_answer") {
    (void)study_.answer({.block = "pair",
                         .procedure = "constant_stimuli",
                         .medium = "viscous",
                         .quantity = "viscosity_pa_s",
                         .repetition = 1,
                         .intensity = intensity,
                         .reference_intensity = 8.0,
                         .response = response});
    study_.say_after_trial("pair", "confidence", confidence);
    study_.say_after_trial("pair", "feel", feel);
    study_.say_after_trial("pair", "remark", remark);
  }
  void rate(double intensity, double step) {
    (void)study_.answer({.block = "rated",
                         .procedure = "rating",
                         .medium = "viscous",
                         .quantity = "viscosity_pa_s",
                         .repetition = 1,
                         .intensity = intensity,
                         .response = step});
  }
  StudyResults results() { return results_of(load_study(study_.store()), {}); }
  static double value(const StudyResults& results, const std::string& name) {
    const Estimate* const found = results.find(name);
    EXPECT_NE(found, nullptr) << name;
    return found == nullptr ? 0.0 : found->value.value_or(-99.0);
  }

  HandMadeStudy study_{kProtocol};
};

TEST_F(QuestionResultsTest, ConfidenceIsToldAgainstRightAndWrongAndTheStimulus) {
  study_.add("P01");
  pair(16, 1, "6", "honey");           // This answer is right.
  pair(16, 0, "2", "oil", "a click");  // This answer is wrong.
  pair(4, 0, "5", "oil");              // This answer is right.
  pair(4, 1, "5", "oil");              // This answer is wrong.
  study_.add("P02");
  pair(16, 1, "4", "honey");
  pair(4, 0, "4", "honey");
  pair(4, 1, "1", "honey");
  const StudyResults found = results();
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence"), 0.5 * (4.5 + 3.0));
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence.median"), 0.5 * (5.0 + 4.0));
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence.mean_at_16"), 4.0);
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence.mean_at_4"), 0.5 * (5.0 + 2.5));
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence.when_right"), 0.5 * (5.5 + 4.0));
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence.when_wrong"), 0.5 * (3.5 + 1.0));
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence.right_minus_wrong"),
                   0.5 * (2.0 + 3.0));
  // P01: (6, 2), (6, 5) and (5, 2) are ordered and (5, 5) is a tie, which gives 3.5 of 4. P02:
  // 2 of 2.
  EXPECT_DOUBLE_EQ(value(found, "pair.question.confidence.type_2_auroc"), 0.5 * (0.875 + 1.0));
  EXPECT_DOUBLE_EQ(value(found, "pair.question.feel.honey"), 0.5 * (0.25 + 1.0));
  EXPECT_DOUBLE_EQ(value(found, "pair.question.feel.oil"), 0.5 * (0.75 + 0.0));
  const ResultsSection& section = section_of(found, "pair_questions");
  ASSERT_EQ(section.free_answers.size(), 1U);
  EXPECT_EQ(section.free_answers[0].answer, "trial 2: a click");
}

TEST_F(QuestionResultsTest, WhoLeftAnswersOutIsNamed) {
  study_.add("P01");
  pair(16, 1, "6", "honey");
  const StudyResults found = results();
  const ResultsSection& section = section_of(found, "pair_questions");
  ASSERT_EQ(section.excluded.size(), 1U);
  EXPECT_EQ(section.excluded[0].reason,
            "pair: 1 of 3 questions after trials were not answered");
}

TEST_F(QuestionResultsTest, ARatingHasItsMeansItsTrendAndItsRankCorrelation) {
  study_.add("P01");
  rate(1, 1);
  rate(2, 3);
  rate(4, 5);
  study_.add("P02");
  rate(1, 2);
  rate(2, 3);
  rate(4, 4);
  const StudyResults found = results();
  EXPECT_DOUBLE_EQ(value(found, "rated.rating.mean_at_1"), 1.5);
  EXPECT_DOUBLE_EQ(value(found, "rated.rating.median_at_4"), 4.5);
  EXPECT_DOUBLE_EQ(value(found, "rated.rating"), 3.0);
  EXPECT_NEAR(value(found, "rated.rating.per_doubling"), 1.5, 1e-12) << "2 and 1 steps";
  EXPECT_TRUE(found.find("rated.rating.per_doubling")->primary);
  EXPECT_NEAR(value(found, "rated.rating.rank_correlation"), 1.0, 1e-12);
}

TEST(RankCorrelation, IsThatOfPublishedTables) {
  // Ties share their rank, so r of (1, 2.5, 2.5, 4) and (1, 2, 3, 4) is 4.5 / sqrt(4.5 * 5).
  EXPECT_NEAR(rank_correlation({1, 2, 2, 3}, {1, 2, 3, 4}).value(), 0.948683, 1e-6);
  EXPECT_NEAR(rank_correlation({1, 2, 3}, {3, 2, 1}).value(), -1.0, 1e-12);
  EXPECT_FALSE(rank_correlation({1, 2}, {1, 2}));
  EXPECT_FALSE(rank_correlation({1, 1, 1}, {1, 2, 3}));
}

TEST(TypeTwoArea, IsHalfWhereConfidenceSaysNothing) {
  const auto answer = [](double value, std::optional<bool> right) {
    return RatedAnswer{.value = value, .was_right = right};
  };
  EXPECT_DOUBLE_EQ(*type_2_auroc({answer(3, true), answer(3, false), answer(9, {})}), 0.5);
  EXPECT_DOUBLE_EQ(*type_2_auroc({answer(1, true), answer(3, false)}), 0.0);
  EXPECT_FALSE(type_2_auroc({answer(1, true)}));
}

}  // namespace question_results_test
}  // namespace jnd::analysis
