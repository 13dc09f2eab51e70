#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/psychometric_function.h"
#include "experiments/adaptive/method_of_limits.h"
#include "experiments/procedures/adaptive_trial.h"
#include "experiments/procedures/limits_procedure.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/quest_plus_procedure.h"
#include "experiments/procedures/staircase_procedure.h"
#include "experiments/protocol/study_reader.h"
#include "support/sanitizer.h"

namespace jnd::experiments {
namespace adaptive_procedures_test {

constexpr double kPse = 7.0;
constexpr double kWeberFraction = 0.3;

/// Returns the block of a study whose one block has these keys besides those of every block.
Block block_with(const std::string& keys) {
  const Study study = read_study_text(R"json({
    "format": 1, "name": "adaptive", "languages": ["en"], "title": {"en": "Adaptive"},
    "authors": ["A. Author"],
    "stages": [{"kind": "block", "name": "one", "medium": "viscous",
      "instruction": {"en": "Compare."}, "question": {"en": "Thicker?"},
      "expected_trial_s": 5, )json" + keys +
                                          "}]}",
                                      "study.json");
  return std::get<Block>(study.stages.front().content);
}

const std::string kStaircase = R"json("procedure": "staircase",
    "reference_viscosity_pa_s": 8, "start_viscosity_pa_s": [16, 4],
    "lowest_viscosity_pa_s": 1, "highest_viscosity_pa_s": 64,
    "step_ratio": [1.5, 1.25, 1.1], "max_reversals": 14, "max_trials": 200)json";
const std::string kLimits = R"json("procedure": "limits", "task": "yes_no",
    "viscosity_pa_s": [2, 3, 4, 5, 6, 8, 10, 12, 16, 20], "num_series": 12)json";
const std::string kQuestPlus = R"json("procedure": "quest_plus",
    "viscosity_pa_s": [3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 18, 24],
    "reference_viscosity_pa_s": 8, "pse_viscosity_pa_s": [4, 16], "max_trials": 120)json";

/// Returns the answers of an observer with this curve to what the procedure draws, until it
/// ends.
std::vector<AnsweredTrial> answered_by_observer(const Block& block, std::uint64_t seed) {
  std::vector<AnsweredTrial> answered;
  const Procedure& procedure = procedure_named(block.procedure);
  core::RandomStream observer(seed, "observer");
  while (answered.size() < 2000) {
    core::RandomStream order(seed, "order", {static_cast<std::int64_t>(answered.size())});
    const std::vector<PlannedTrial> next = procedure.draw_next(block, answered, order);
    if (next.empty()) return answered;
    EXPECT_EQ(next.size(), 1U) << "the answer before decides about the next";
    const double yes = core::standard_normal_cdf(std::log(*next.front().intensity / kPse) /
                                                 std::log1p(kWeberFraction));
    answered.push_back({next.front(), observer.with_probability(yes) ? 1.0 : 0.0});
  }
  ADD_FAILURE() << "it never ends";
  return answered;
}

/// Returns the geometric mean of the estimate over observers with different random numbers.
template <typename Estimate>
double mean_estimate(const Block& block, const Estimate& estimate) {
  constexpr int kRuns = 60;
  double sum_ln = 0.0;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    sum_ln += std::log(estimate(answered_by_observer(block, seed)));
  }
  return std::exp(sum_ln / kRuns);
}

class EveryAdaptiveProcedure : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryAdaptiveProcedure, GoesOnFromTheAnswersAloneAlsoAfterOneWasTakenBack) {
  const Block block = block_with(GetParam());
  const Procedure& procedure = procedure_named(block.procedure);
  std::vector<AnsweredTrial> answered = answered_by_observer(block, 3);
  EXPECT_GT(answered.size(), 20U);
  for (std::size_t i = 0; i < answered.size(); ++i) {
    EXPECT_EQ(answered[i].planned.position, static_cast<int>(i) + 1);
    EXPECT_EQ(answered[i].planned.reference_intensity, block.reference_intensity);
  }
  const AnsweredTrial last = answered.back();
  answered.pop_back();
  core::RandomStream order(3, "order", {static_cast<std::int64_t>(answered.size())});
  const PlannedTrial again = procedure.draw_next(block, answered, order).at(0);
  EXPECT_EQ(again.intensity, last.planned.intensity);
  EXPECT_EQ(again.series, last.planned.series);
}

TEST_P(EveryAdaptiveProcedure, LastsAboutAsLongAsIsExpected) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const Block block = block_with(GetParam());
  const auto expected =
      static_cast<double>(procedure_named(block.procedure).expected_trials(block));
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    sum += static_cast<double>(answered_by_observer(block, seed).size());
  }
  EXPECT_GT(expected, 0.6 * sum / 20.0);
  EXPECT_LT(expected, 1.7 * sum / 20.0);
}

INSTANTIATE_TEST_SUITE_P(All, EveryAdaptiveProcedure,
                         ::testing::Values(kStaircase, kLimits, kQuestPlus));

TEST(StaircaseProcedure, ExpectsTheTrialsThatItsRuleAndStepsTake) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  for (const char* rule :
       {R"("step_ratio": [1.5, 1.25, 1.1], "max_reversals": 10)",
        R"("step_ratio": [1.1], "max_reversals": 10)",
        R"("step_ratio": [1.5], "max_reversals": 6)",
        R"("step_ratio": [1.25], "num_down": 1, "max_reversals": 10)",
        R"("step_ratio": [1.3, 1.1], "num_down": 3, "max_reversals": 8)",
        R"("step_ratio": [1.3], "num_down": 1, "down_per_up_ratio": 0.333)",
        R"("level_scale": "linear", "step_viscosity_pa_s": [4, 2, 1], "max_reversals": 12)"}) {
    const Block block = block_with(
        R"("procedure": "staircase", "reference_viscosity_pa_s": 8, "max_trials": 500,
           "start_viscosity_pa_s": [16, 4], "lowest_viscosity_pa_s": 1,
           "highest_viscosity_pa_s": 64, )" +
        std::string(rule));
    double sum = 0.0;
    constexpr int kRuns = 40;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
      sum += static_cast<double>(answered_by_observer(block, seed).size());
    }
    const int expected = procedure_named("staircase").expected_trials(block);
    EXPECT_NEAR(expected / (sum / kRuns), 1.0, 0.25) << rule;
  }
}

TEST(StaircaseProcedure, ExpectsNoMoreThanItsMostTrials) {
  const Procedure& staircase = procedure_named("staircase");
  const Block few = block_with(R"("procedure": "staircase", "reference_viscosity_pa_s": 8,
      "start_viscosity_pa_s": [16, 4], "lowest_viscosity_pa_s": 1,
      "highest_viscosity_pa_s": 64, "step_ratio": [1.05], "catch_probability": 0.2,
      "max_trials": 12)");
  EXPECT_EQ(staircase.most_trials(few), 30);
  EXPECT_EQ(staircase.expected_trials(few), 30);
  const Block many = block_with(kStaircase);
  EXPECT_EQ(staircase.most_trials(many), 400);
  EXPECT_LT(staircase.expected_trials(many), 120);
}

TEST(LimitsProcedure, HasNoMoreTrialsThanSeriesHaveLevels) {
  const Block block = block_with(kLimits);
  const Procedure& limits = procedure_named("limits");
  EXPECT_EQ(limits.most_trials(block), 120);
  EXPECT_EQ(limits.expected_trials(block), 60);
}

TEST(StaircaseProcedure, FindsTheLevelAtWhichTheRuleBalances) {
  const Block block = block_with(kStaircase);
  const Staircase staircase(staircase_rule_of(block, 1));
  // 71 % say yes where ln(x / pse) is 0.545 standard deviations.
  const double target = kPse * std::exp(0.5450 * std::log1p(kWeberFraction));
  EXPECT_NEAR(staircase.target_probability(), 0.7071, 1e-4);
  const double found = mean_estimate(block, [&](const std::vector<AnsweredTrial>& answered) {
    return *staircase.threshold(staircase.after(level_answers(answered, 1))).level;
  });
  EXPECT_NEAR(found / target, 1.0, 0.06);
}

TEST(StaircaseProcedure, InterleavesOneForEachStart) {
  const Block block = block_with(kStaircase);
  const std::vector<AnsweredTrial> answered = answered_by_observer(block, 5);
  const std::vector<LevelAnswer> first = level_answers(answered, 1);
  const std::vector<LevelAnswer> second = level_answers(answered, 2);
  EXPECT_EQ(first.size() + second.size(), answered.size());
  EXPECT_EQ(first.front().level, 16.0);
  EXPECT_EQ(second.front().level, 4.0);
  std::set<std::vector<int>> beginnings;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::vector<int> series;
    for (const AnsweredTrial& trial : answered_by_observer(block, seed)) {
      if (series.size() < 6) series.push_back(*trial.planned.series);
    }
    beginnings.insert(series);
  }
  EXPECT_GT(beginnings.size(), 5U) << "nobody can tell whose turn it is";
}

TEST(LimitsProcedure, FindsTheMiddleOfTheCurveFromBothSides) {
  const Block block = block_with(kLimits);
  EXPECT_FALSE(procedure_named("limits").form(block).has_reference);
  const double found = mean_estimate(block, [&](const std::vector<AnsweredTrial>& answered) {
    // The estimate is the mean of the transitions, each between the levels before and after a
    // change.
    double sum_ln = 0.0;
    int count = 0;
    for (std::size_t i = 1; i < answered.size(); ++i) {
      if (answered[i].planned.series != answered[i - 1].planned.series ||
          answered[i].response == answered[i - 1].response) {
        continue;
      }
      sum_ln +=
          0.5 * std::log(*answered[i].planned.intensity * *answered[i - 1].planned.intensity);
      ++count;
    }
    return std::exp(sum_ln / count);
  });
  EXPECT_NEAR(found / kPse, 1.0, 0.06);
}

TEST(LimitsProcedure, SeriesRiseAndFallInTurnFromDrawnStarts) {
  const Block block = block_with(kLimits);
  std::set<double> starts;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<AnsweredTrial> answered = answered_by_observer(block, seed);
    EXPECT_EQ(answered.back().planned.series, 12);
    int rising = 0;
    for (int number = 1; number <= 12; ++number) {
      const std::vector<LevelAnswer> series = level_answers(answered, number);
      ASSERT_FALSE(series.empty());
      starts.insert(series.front().level);
      rising += series.front().level < 7.0 ? 1 : 0;
    }
    EXPECT_EQ(rising, 6);
  }
  EXPECT_EQ(starts, (std::set<double>{2, 3, 4, 12, 16, 20}));
}

TEST(QuestPlusProcedure, FindsPseAndWeberFractionOfTheObserver) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const Block block = block_with(kQuestPlus);
  const QuestPlus quest(quest_plus_rule_of(block));
  const auto estimate = [&](std::size_t parameter) {
    return mean_estimate(block, [&, parameter](const std::vector<AnsweredTrial>& answered) {
      return quest.estimates(quest.posterior(level_answers(answered)))[parameter].mean;
    });
  };
  EXPECT_EQ(quest.rule().model.parameters[1].name, "weber_fraction");
  EXPECT_NEAR(estimate(0) / kPse, 1.0, 0.04);
  EXPECT_NEAR(estimate(1) / kWeberFraction, 1.0, 0.12);
}

TEST(QuestPlusProcedure, SaysWhenItsPosteriorReachesTheEndOfAGrid) {
  const Block wide = block_with(kQuestPlus);
  const Procedure& procedure = procedure_named("quest_plus");
  EXPECT_EQ(procedure.caution(wide, answered_by_observer(wide, 1)), "");
  std::vector<AnsweredTrial> all_yes;
  for (int i = 0; i < 20; ++i) all_yes.push_back({{.intensity = 4.0}, 1.0});
  const std::string caution = procedure.caution(wide, all_yes);
  EXPECT_NE(caution.find("the lower end of `pse_viscosity_pa_s` (4)"), std::string::npos)
      << caution;
  EXPECT_EQ(procedure.caution(wide, {}).find("weber_fraction_"), std::string::npos)
      << "no unit behind what has none";
  EXPECT_EQ(procedure_named("staircase").caution(wide, all_yes), "") << "it has no grid";
}

TEST(QuestPlusProcedure, EndsWhenTheWeberFractionIsKnownWellEnough) {
  const Block block = block_with(kQuestPlus + R"(, "stop_sd_ln": 0.4, "min_trials": 10)");
  const std::size_t num_trials = answered_by_observer(block, 4).size();
  EXPECT_GE(num_trials, 10U);
  EXPECT_LT(num_trials, 80U);
}

}  // namespace adaptive_procedures_test
}  // namespace jnd::experiments
