#include "experiments/session/session_limits.h"

#include <gtest/gtest.h>

namespace jnd::experiments {
namespace session_limits_test {

Stage block(const std::string& name, int num_stimuli) {
  Stage stage;
  stage.name = name;
  stage.content =
      Block{.procedure = "magnitude_estimation",
            .intensities = std::vector<double>(static_cast<std::size_t>(num_stimuli)),
            .repetitions = 2,
            .free_space_between_s = 2.0,
            .expected_trial_s = 8.0};
  return stage;
}

Stage rest() {
  Stage stage;
  stage.name = "rest";
  stage.content = Break{.instruction = {}, .duration_s = 60.0};
  return stage;
}

const std::vector<Stage> kStages = {block("first", 10), rest(), block("second", 6),
                                    block("third", 5), rest()};

TEST(SessionLimits, AnswersCountSinceTheLastBreakThatIsOver) {
  std::vector<const Stage*> stages;
  for (const Stage& stage : kStages) stages.push_back(&stage);
  SessionState state;
  const auto answered = [](std::int64_t stage, bool is_answered) {
    TrialState trial{.stage = stage};
    if (is_answered) trial.is_answered = true;
    return trial;
  };
  state.trials = {answered(0, true), answered(0, true), answered(2, true), answered(3, true),
                  answered(3, false)};
  state.stage = 0;
  EXPECT_EQ(num_answers_since_break(stages, state), 4);
  state.stage = 1;
  EXPECT_EQ(num_answers_since_break(stages, state), 4) << "the break is not over yet";
  state.stage = 3;
  EXPECT_EQ(num_answers_since_break(stages, state), 2);
  state.stage = 5;
  EXPECT_EQ(num_answers_since_break(stages, state), 0);
}

TEST(SessionLimits, AreToldWhenTheyArePassed) {
  EXPECT_EQ(limit_advice({}, 1000, 1e6), "");
  const SessionLimits limits = {.max_duration_s = 3600.0, .max_trials_without_break = 60};
  EXPECT_EQ(limit_advice(limits, 59, 3600.0), "");
  EXPECT_EQ(limit_advice(limits, 60, 3600.0), "60 trials without a break, of at most 60");
  EXPECT_EQ(limit_advice(limits, 0, 3660.0), "61 min so far, of at most 60");
}

TEST(SessionLimits, ExposureIsOverWhenItIsReached) {
  const core::Exposure some{.force_time_n_s = 900.0, .under_force_s = 600.0};
  EXPECT_EQ(exposure_words({}, some), "");
  EXPECT_EQ(exposure_words({.max_force_time_n_s = 901.0, .max_under_force_s = 601.0}, some),
            "");
  EXPECT_EQ(exposure_words({.max_under_force_s = 600.0}, some),
            "10.0 min under force, of at most 10.0");
  EXPECT_EQ(exposure_words({.max_force_time_n_s = 900.0}, some),
            "900 N s of force, of at most 900");
}

}  // namespace session_limits_test
}  // namespace jnd::experiments
