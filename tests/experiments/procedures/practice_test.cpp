#include "experiments/procedures/practice.h"

#include <gtest/gtest.h>

namespace jnd::experiments {
namespace practice_test {

/// Returns a block in which the test 4 is less than the reference 8 and 16 is more. For 8, no
/// answer is right.
Block practice_block(Practice practice) {
  return {.procedure = "constant_stimuli",
          .medium = "viscous",
          .quantity = "viscosity_pa_s",
          .intensities = {4.0, 8.0, 16.0},
          .reference_intensity = 8.0,
          .repetitions = 20,
          .practice = practice};
}

AnsweredTrial answer(double intensity, double response) {
  return {{.intensity = intensity, .reference_intensity = 8.0}, response};
}

const Practice kThreeOfFour = {
    .min_correct_ratio = 0.75, .num_trials_judged = 4, .max_trials = 8};
const AnsweredTrial kRight = answer(16.0, 1.0), kWrong = answer(16.0, 0.0),
                    kNeither = answer(8.0, 1.0);

std::size_t num_next(const Block& block, const std::vector<AnsweredTrial>& answered) {
  core::RandomStream stream(1, "order");
  return next_trials(block, answered, stream).size();
}

TEST(Practice, EndsWhenEnoughOfTheLastAnswersWereRight) {
  const Block block = practice_block(kThreeOfFour);
  EXPECT_FALSE(practice_state(block, {}).is_over);
  EXPECT_FALSE(practice_state(block, {kRight, kRight, kRight}).is_over)
      << "four have to be judged";
  EXPECT_FALSE(practice_state(block, {kRight, kRight, kWrong, kWrong}).is_over);
  EXPECT_TRUE(practice_state(block, {kWrong, kRight, kRight, kRight}).is_over);
  const PracticeState late =
      practice_state(block, {kWrong, kWrong, kWrong, kRight, kRight, kRight});
  EXPECT_TRUE(late.criterion_is_met) << "only the last four count";
  EXPECT_EQ(late.num_correct, 3);
  EXPECT_EQ(late.num_trials, 6);
}

TEST(Practice, PassesOverTrialsToWhichNoAnswerIsRight) {
  const Block block = practice_block(kThreeOfFour);
  EXPECT_FALSE(practice_state(block, {kRight, kRight, kRight, kNeither}).is_over);
  EXPECT_TRUE(practice_state(block, {kRight, kNeither, kRight, kNeither, kRight, kRight})
                  .criterion_is_met);
}

TEST(Practice, EndsAfterTheMostTrialsInAnyCase) {
  const Block block = practice_block(kThreeOfFour);
  const std::vector<AnsweredTrial> wrong(8, kWrong);
  const PracticeState state = practice_state(block, wrong);
  EXPECT_TRUE(state.is_over);
  EXPECT_FALSE(state.criterion_is_met);
  EXPECT_EQ(practice_words(block, state),
            "practice over after 8 trials: 0 of the last 4 answers were right, at least 3 were "
            "asked for");
}

TEST(Practice, SaysThatItWasBrokenOff) {
  const Block block = practice_block(kThreeOfFour);
  const std::vector<AnsweredTrial> two = {kRight, kWrong};
  EXPECT_EQ(
      practice_words(block, practice_state(block, two)),
      "practice broken off after 2 trials: 1 of the last 2 answers were right, at least 3 "
      "of 4 were asked for");
  EXPECT_EQ(practice_words(block, practice_state(block, {kWrong})),
            "practice broken off after 1 trial: 0 of the last 1 answers were right, at least 3 "
            "of 4 were asked for");
}

TEST(Practice, SevenTenthsOfTenAreSeven) {
  const Block block =
      practice_block({.min_correct_ratio = 0.7, .num_trials_judged = 10, .max_trials = 40});
  std::vector<AnsweredTrial> answered(7, kRight);
  answered.resize(10, kWrong);
  EXPECT_TRUE(practice_state(block, answered).criterion_is_met);
  answered[0] = kWrong;
  EXPECT_FALSE(practice_state(block, answered).criterion_is_met);
}

TEST(Practice, NothingIsDrawnOnceItIsOverAndOneTrialBefore) {
  const Block block = practice_block(kThreeOfFour);
  EXPECT_EQ(num_next(block, {}), 1U);
  EXPECT_EQ(num_next(block, {kRight, kRight, kRight}), 1U);
  EXPECT_EQ(num_next(block, {kRight, kRight, kRight, kRight}), 0U);
  EXPECT_EQ(expected_trials(block), 8);
  Block data = block;
  data.practice.reset();
  EXPECT_EQ(expected_trials(data), 60);
  EXPECT_EQ(most_trials(block), 8);
  EXPECT_EQ(most_trials(data), 60);
  EXPECT_EQ(expected_trials_words(block), "at most 8");
  EXPECT_EQ(expected_trials_words(data), "60");
  EXPECT_EQ(num_next(data, {}), 60U);
}

}  // namespace practice_test
}  // namespace jnd::experiments
