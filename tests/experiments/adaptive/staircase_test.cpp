#include "experiments/adaptive/staircase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "support/sanitizer.h"

namespace jnd::experiments {
namespace staircase_test {

StaircaseRule one_up_two_down() {
  return {.step_sizes = {2.0, 1.0},
          .start = 10.0,
          .lowest = 0.0,
          .highest = 20.0,
          .max_trials = 1000};
}

/// Answers what `yes` says to each level that the staircase asks for, until it ends.
std::vector<LevelAnswer> run(const Staircase& staircase,
                             const std::function<bool(double level)>& yes) {
  std::vector<LevelAnswer> answers;
  for (auto state = staircase.after({}); !state.is_finished();
       state = staircase.after(answers)) {
    answers.push_back({state.next_level, yes(state.next_level)});
  }
  return answers;
}

/// The levels that the staircase asks for when the answers are these, "y" or "n" each.
std::vector<double> levels_for(const Staircase& staircase, const std::string& letters) {
  std::vector<LevelAnswer> answers;
  std::vector<double> levels = {staircase.after({}).next_level};
  for (const char letter : letters) {
    answers.push_back({levels.back(), letter == 'y'});
    levels.push_back(staircase.after(answers).next_level);
  }
  return levels;
}

std::vector<LevelAnswer> answers_for(const Staircase& staircase, const std::string& letters) {
  const std::vector<double> levels = levels_for(staircase, letters);
  std::vector<LevelAnswer> answers;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    answers.push_back({levels[i], letters[i] == 'y'});
  }
  return answers;
}

TEST(Staircase, IsWorkedByHandForOneUpTwoDown) {
  const Staircase staircase(one_up_two_down());
  // The staircase goes two steps of 2 down. A "no" turns it; from then on its steps are of 1,
  // the first one included.
  EXPECT_EQ(levels_for(staircase, "yyyynynyy"),
            (std::vector<double>{10, 10, 8, 8, 6, 7, 7, 8, 8, 7}));
  const auto state = staircase.after(answers_for(staircase, "yyyynynyy"));
  ASSERT_EQ(state.reversals.size(), 2u);
  EXPECT_EQ(state.reversals[0].trial, 4u);
  EXPECT_EQ(state.reversals[0].level, 6.0);
  EXPECT_EQ(state.reversals[1].trial, 8u);
  EXPECT_EQ(state.reversals[1].level, 8.0);
  EXPECT_EQ(staircase.threshold(state).level.value(), 7.0);
  EXPECT_EQ(staircase.threshold(state).num_reversals, 2);
}

TEST(Staircase, CountsAnswersInARowFromTheLastStepOn) {
  // Three lowering answers are one step and a half, and not two steps.
  EXPECT_EQ(levels_for(Staircase(one_up_two_down()), "yyyny"),
            (std::vector<double>{10, 10, 8, 8, 9, 9}));
}

TEST(Staircase, TakesEitherAnswerForTheLoweringOne) {
  StaircaseRule rule = one_up_two_down();
  rule.yes_lowers = false;
  EXPECT_EQ(levels_for(Staircase(rule), "nnnny"), (std::vector<double>{10, 10, 8, 8, 6, 7}));
}

TEST(Staircase, StepsByRatiosInALogarithmicScale) {
  StaircaseRule rule = one_up_two_down();
  rule.scale = LevelScale::kLogarithmic;
  rule.lowest = 0.1;
  rule.num_down = 1;
  rule.step_sizes = {std::log(2.0)};
  const Staircase staircase(rule);
  const auto levels = levels_for(staircase, "yyn");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(levels[i], (std::vector<double>{10, 5, 2.5, 5})[i], 1e-12);
  }
  // The threshold is the geometric mean of 2.5 and 10.
  const auto state = staircase.after(answers_for(staircase, "yynny"));
  EXPECT_NEAR(staircase.threshold(state).level.value(), 5.0, 1e-12);
}

TEST(Staircase, GoesOnFromTheLevelThatWasPresented) {
  const Staircase staircase(one_up_two_down());
  // 9.5 was presented in place of 10, and 7 in place of 7.5.
  EXPECT_EQ(staircase.after({{10, true}, {9.5, true}}).next_level, 7.5);
  const auto state = staircase.after({{10, true}, {9.5, true}, {7.0, false}});
  EXPECT_EQ(state.next_level, 8.0);
  EXPECT_EQ(state.reversals.at(0).level, 7.0);
}

TEST(Staircase, ForgetsAnAnswerThatIsTakenBack) {
  const Staircase staircase(one_up_two_down());
  auto answers = answers_for(staircase, "yyyyn");
  const double before = staircase.after(answers_for(staircase, "yyyy")).next_level;
  EXPECT_NE(staircase.after(answers).next_level, before);
  answers.pop_back();
  EXPECT_EQ(staircase.after(answers).next_level, before);
  EXPECT_TRUE(staircase.after(answers).reversals.empty());
}

TEST(Staircase, StaysAtItsBoundAndCountsWhatItBlocks) {
  StaircaseRule rule = one_up_two_down();
  rule.start = 17.0;
  const Staircase staircase(rule);
  EXPECT_EQ(levels_for(staircase, "nnnn"), (std::vector<double>{17, 19, 20, 20, 20}));
  const auto state = staircase.after(answers_for(staircase, "nnnn"));
  EXPECT_EQ(state.num_blocked, 2);
  EXPECT_TRUE(state.reversals.empty());
}

TEST(Staircase, TurnsAtItsBoundOnlyWhenItHasMovedThere) {
  StaircaseRule rule = one_up_two_down();
  rule.start = 20.0;
  const Staircase staircase(rule);
  // The staircase is blocked at once, and then goes down: the levels never turned.
  const auto blocked = staircase.after(answers_for(staircase, "nyy"));
  EXPECT_TRUE(blocked.reversals.empty());
  EXPECT_EQ(blocked.next_level, 18.0);
  // The staircase goes up again to the bound, is blocked, and goes down: a valley at 18 and a
  // peak on the bound.
  const auto turned = staircase.after(answers_for(staircase, "nyynnnyy"));
  ASSERT_EQ(turned.reversals.size(), 2u);
  EXPECT_FALSE(turned.reversals[0].at_bound);
  EXPECT_EQ(turned.reversals[1].level, 20.0);
  EXPECT_TRUE(turned.reversals[1].at_bound);
  EXPECT_EQ(staircase.threshold(turned).num_at_bound, 1);
}

TEST(Staircase, IsOnItsBoundsDespiteRounding) {
  StaircaseRule rule = one_up_two_down();
  rule.scale = LevelScale::kLogarithmic;
  rule.lowest = 0.1;
  rule.highest = 10.0;
  rule.num_down = 1;
  for (const double ratio : {1.1, 1.3, 1.7}) {
    for (int steps = 1; steps < 8; ++steps) {
      rule.step_sizes = {std::log(ratio)};
      for (const char letter : {'y', 'n'}) {
        const double bound = letter == 'y' ? rule.lowest : rule.highest;
        rule.start = bound * std::pow(ratio, letter == 'y' ? steps : -steps);
        const Staircase staircase(rule);
        const auto answers = answers_for(staircase, std::string(steps + 1, letter));
        EXPECT_EQ(answers.back().level, bound);
        EXPECT_EQ(staircase.after(answers).num_blocked, 1) << ratio << ' ' << steps;
      }
    }
  }
}

TEST(Staircase, EndsAfterAsManyReversalsTrialsOrBlockedStepsAsTheRuleSays) {
  StaircaseRule rule = one_up_two_down();
  rule.max_reversals = 3;
  rule.num_reversals_averaged = 2;
  rule.max_trials = 40;
  const std::string swinging = "yyyynyynyyn";
  const auto end_after = [&](std::size_t num_answers) {
    const Staircase staircase(rule);
    return staircase.after(answers_for(staircase, swinging.substr(0, num_answers))).end;
  };
  EXPECT_EQ(end_after(6), StaircaseEnd::kNotFinished);
  EXPECT_EQ(end_after(8), StaircaseEnd::kReversals);
  rule.max_trials = 6;
  EXPECT_EQ(end_after(6), StaircaseEnd::kTrials);
  rule.max_trials = 40;
  rule.max_reversals.reset();
  rule.max_blocked_in_a_row = 3;
  const Staircase staircase(rule);
  EXPECT_FALSE(staircase.after(answers_for(staircase, "nnnnnnn")).is_finished());
  EXPECT_EQ(staircase.after(answers_for(staircase, "nnnnnnnn")).end, StaircaseEnd::kBlocked);
  // A step that moves restarts the count.
  EXPECT_FALSE(staircase.after(answers_for(staircase, "nnnnnnnyynnn")).is_finished());
}

TEST(Staircase, CountsAnswersAfterItsEndWhichDecideNothing) {
  StaircaseRule rule = one_up_two_down();
  rule.max_trials = 2;
  const Staircase staircase(rule);
  const StaircaseState at_end = staircase.after({{10, true}, {10, true}});
  const StaircaseState state = staircase.after({{10, true}, {10, true}, {8, false}, {9, true}});
  EXPECT_EQ(state.end, StaircaseEnd::kTrials);
  EXPECT_EQ(state.num_after_end, 2);
  EXPECT_EQ(at_end.num_after_end, 0);
  EXPECT_EQ(state.reversals.size(), at_end.reversals.size());
  EXPECT_EQ(state.next_level, at_end.next_level);
}

TEST(Staircase, AveragesTheLastEvenNumberOfReversals) {
  StaircaseRule rule = one_up_two_down();
  rule.num_reversals_averaged = 4;
  const Staircase staircase(rule);
  StaircaseState state;
  EXPECT_FALSE(staircase.threshold(state).level.has_value());
  state.reversals = {{0, 100.0, false}};
  EXPECT_FALSE(staircase.threshold(state).level.has_value());
  state.reversals.assign({{0, 100.0, true}, {1, 4.0, false}, {2, 6.0, false}});
  EXPECT_EQ(staircase.threshold(state).level.value(), 5.0);
  EXPECT_EQ(staircase.threshold(state).num_at_bound, 0);
  state.reversals.assign(
      {{0, 100, false}, {1, 4, false}, {2, 6, false}, {3, 5, false}, {4, 7, true}});
  EXPECT_EQ(staircase.threshold(state).level.value(), 5.5);
  EXPECT_EQ(staircase.threshold(state).num_reversals, 4);
  EXPECT_EQ(staircase.threshold(state).num_at_bound, 1);
}

TEST(Staircase, KeepsToItsGridAndNeverStandsStill) {
  StaircaseRule rule = one_up_two_down();
  rule.num_down = 1;
  rule.grid = {1.0, 4.0, 10.0, 11.0, 18.0};
  rule.step_sizes = {6.0, 0.1};
  const Staircase staircase(rule);
  // 10 - 6 is 4. Up by 0.1 means the next level, twice; 11 + 0.1 means 18, the top.
  EXPECT_EQ(levels_for(staircase, "ynnnn"), (std::vector<double>{10, 4, 10, 11, 18, 18}));
  EXPECT_EQ(staircase.after(answers_for(staircase, "ynnnn")).num_blocked, 1);
  // A level that is off the grid counts as the nearest one.
  EXPECT_EQ(staircase.after({{10.2, true}}).next_level, 4.0);
}

TEST(StaircaseTarget, IsThatOfLevittAndOfKaernbach) {
  // Levitt 1971, table I, gives 0.707, 0.794, 0.841; the mirrored rules give the complements.
  EXPECT_NEAR(staircase_target_probability(1, 2, 1.0), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(staircase_target_probability(1, 3, 1.0), std::cbrt(0.5), 1e-14);
  EXPECT_NEAR(staircase_target_probability(1, 4, 1.0), std::pow(0.5, 0.25), 1e-14);
  EXPECT_NEAR(staircase_target_probability(2, 1, 1.0), 1.0 - std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(staircase_target_probability(1, 1, 1.0), 0.5, 1e-14);
  EXPECT_NEAR(staircase_target_probability(3, 3, 1.0), 0.5, 1e-14);
  // Kaernbach 1991 gives 75 % for steps up that are three times those down.
  EXPECT_NEAR(staircase_target_probability(1, 1, 1.0 / 3.0), 0.75, 1e-14);
  EXPECT_NEAR(staircase_step_ratio(0.75), 1.0 / 3.0, 1e-14);
  for (const double target : {0.1, 0.5, 0.6, 0.9}) {
    const double ratio = staircase_step_ratio(target, 1, 2);
    EXPECT_NEAR(staircase_target_probability(1, 2, ratio), target, 1e-12);
  }
  EXPECT_THROW((void)staircase_step_ratio(1.0), core::Error);
  EXPECT_THROW((void)staircase_step_ratio(std::nan("")), core::Error);
  EXPECT_THROW((void)staircase_target_probability(0, 1, 1.0), core::Error);
}

/// The mean threshold of 200 staircases with a simulated observer, whose lowering answers
/// follow a cumulative Gauss curve of mean 10 and standard deviation 2. It is given as a
/// probability on that curve.
double reached_probability(StaircaseRule rule) {
  double sum = 0.0;
  for (int i = 0; i < 200; ++i) {
    core::RandomStream observer(5, "staircase_test", {i});
    const Staircase staircase(rule);
    const auto answers = run(staircase, [&](double level) {
      return observer.with_probability(core::standard_normal_cdf((level - 10.0) / 2.0));
    });
    sum += staircase.threshold(staircase.after(answers)).level.value();
  }
  return core::standard_normal_cdf((sum / 200.0 - 10.0) / 2.0);
}

TEST(Staircase, ComesToItsTargetProbabilityWithASimulatedObserver) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  StaircaseRule rule = one_up_two_down();
  rule.step_sizes = {1.0, 0.25};
  rule.max_trials = 400;
  rule.num_reversals_averaged = 40;
  EXPECT_NEAR(reached_probability(rule), 0.7071, 0.015);
  rule.num_down = 3;
  EXPECT_NEAR(reached_probability(rule), 0.7937, 0.015);
  rule.num_down = 1;
  EXPECT_NEAR(reached_probability(rule), 0.5, 0.015);
  rule.step_sizes = {0.3};
  rule.down_per_up_ratio = staircase_step_ratio(0.75);
  EXPECT_NEAR(reached_probability(rule), 0.75, 0.015);
}

TEST(Staircase, RefusesARuleThatCannotRun) {
  const auto refused = [](const std::function<void(StaircaseRule&)>& spoil) {
    StaircaseRule rule = one_up_two_down();
    spoil(rule);
    EXPECT_THROW(Staircase{rule}, core::Error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& r) { r.num_up = 0; });
  refused([](auto& r) { r.num_down = 0; });
  refused([](auto& r) { r.step_sizes.clear(); });
  refused([](auto& r) { r.step_sizes = {1.0, 0.0}; });
  refused([&](auto& r) { r.step_sizes = {nan}; });
  refused([](auto& r) { r.down_per_up_ratio = 0.0; });
  refused([&](auto& r) { r.down_per_up_ratio = nan; });
  refused([](auto& r) { r.start = 21.0; });
  refused([&](auto& r) { r.start = nan; });
  refused([](auto& r) { r.highest = r.lowest; });
  refused([](auto& r) { r.scale = LevelScale::kLogarithmic; });
  refused([](auto& r) { r.grid = {10.0}; });
  refused([](auto& r) { r.grid = {10.0, 21.0}; });
  refused([](auto& r) { r.grid = {-1.0, 10.0}; });
  refused([](auto& r) { r.grid = {10.0, 10.0}; });
  refused([](auto& r) { r.grid = {9.0, 11.0}; });
  refused([](auto& r) { r.max_trials = 0; });
  refused([](auto& r) { r.max_reversals = 0; });
  refused([](auto& r) { r.max_blocked_in_a_row = 0; });
  refused([](auto& r) { r.num_reversals_averaged = 3; });
  refused([](auto& r) { r.num_reversals_averaged = 0; });
  EXPECT_THROW((void)Staircase(one_up_two_down()).after({{nan, true}}), core::Error);
}

}  // namespace staircase_test
}  // namespace jnd::experiments
