#include "analysis/planning/power_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/error.h"

namespace jnd::analysis {
namespace power_summary_test {

PlannedAnalysis small() {
  return {.blocks = {{.name = "a", .reference = 1.0, .true_value = 0.3},
                     {.name = "b", .reference = 1.0}},
          .compared = std::pair(0, 1),
          .sizes = {4}};
}

PlannedRun run_of(std::optional<double> p_value, double value, Interval ci95) {
  return {.sizes = {{.estimates = {{value, ci95}, {}},
                     .tests = {{0.5, p_value}, {{}, 0.5}},
                     .num_with_answers = {4, 4},
                     .num_degenerate = {1, 0},
                     .num_at_grid_end = {0, 0}}}};
}

TEST(PowerSummary, CountsByHand) {
  const std::vector<PlannedRun> runs = {run_of(0.01, 0.2, {0.1, 0.4}),
                                        run_of(0.06, 0.4, {0.35, 0.55}),
                                        run_of({}, 0.5, {0.2, {}})};
  const auto summary = summary_of_runs(small(), runs);
  ASSERT_EQ(summary.size(), 1U);
  const PlannedPower& power = summary[0].tests[0];
  EXPECT_EQ(power.num_significant, 1);
  EXPECT_EQ(power.num_undefined, 1) << "an undefined test has found nothing";
  EXPECT_DOUBLE_EQ(power.power, 1.0 / 3.0);
  // The interval is that of Wilson (1927) for 1 of 3.
  EXPECT_NEAR(power.power_low, 0.0615, 1e-4);
  EXPECT_NEAR(power.power_high, 0.7923, 1e-4);
  EXPECT_DOUBLE_EQ(*power.mean_difference, 0.5);
  const PlannedPrecision& a = summary[0].estimates[0];
  EXPECT_DOUBLE_EQ(*a.median, 0.4);
  EXPECT_NEAR(*a.bias, 0.1, 1e-15);
  EXPECT_DOUBLE_EQ(*a.half_width_median, 0.15);
  EXPECT_FALSE(a.half_width_90) << "one interval in three is open";
  EXPECT_DOUBLE_EQ(*a.coverage, 0.5);
  EXPECT_DOUBLE_EQ(*a.degenerate, 0.25);
  const PlannedPrecision& b = summary[0].estimates[1];
  EXPECT_EQ(b.num_undefined, 3);
  EXPECT_FALSE(b.median || b.bias || b.half_width_median || b.coverage);
  EXPECT_THROW((void)summary_of_runs(small(), {}), core::Error);
}

/// Returns a hundred runs. In `num_holding` of them the interval holds 0.3, and in
/// `num_significant` the first test is significant.
std::vector<PlannedRun> hundred_runs(int num_holding, int num_significant) {
  std::vector<PlannedRun> runs;
  for (int run = 0; run < 100; ++run) {
    runs.push_back(run_of(run < num_significant ? 0.01 : 0.5, 0.4,
                          run < num_holding ? Interval{0.2, 0.5} : Interval{0.35, 0.5}));
  }
  return runs;
}

TEST(PowerSummary, IntervalsThatHoldTheTruthTooRarelyAreADoubt) {
  const auto doubts = [](int num_holding) {
    return planning_doubts(small(), summary_of_runs(small(), hundred_runs(num_holding, 5)),
                           /*null_hypothesis=*/false);
  };
  ASSERT_EQ(doubts(69).size(), 1U);
  EXPECT_EQ(doubts(69).front().find("a.weber_fraction: with 4 participants the interval holds "
                                    "the true value in 69 % of the studies, not in 95 %"),
            0U)
      << doubts(69).front();
  EXPECT_TRUE(doubts(95).empty());
  EXPECT_TRUE(doubts(91).empty()) << "so few runs may hold 95 %";
}

TEST(PowerSummary, AQuickEstimateIsNoDoubtWhereTheHierarchicalOneIsBesideIt) {
  PlannedAnalysis both = small();
  both.hierarchical = true;
  std::vector<PlannedRun> runs = hundred_runs(69, 5);
  for (PlannedRun& run : runs) {
    std::vector<PlannedEstimate>& all = run.sizes.front().estimates;
    all = {all[0], {.value = 0.3, .ci95 = {0.2, 0.4}}, all[1], {}};
    run.sizes.front().tests.push_back({});
  }
  EXPECT_TRUE(planning_doubts(both, summary_of_runs(both, runs), false).empty());
  for (PlannedRun& run : runs)
    std::swap(run.sizes.front().estimates[0], run.sizes.front().estimates[1]);
  const auto doubts = planning_doubts(both, summary_of_runs(both, runs), false);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(doubts.front().find("a.weber_fraction_hierarchical: "), 0U) << doubts.front();
}

TEST(PowerSummary, GridsOfQuestPlusThatEndTooEarlyAreADoubt) {
  const auto summary_with = [](int num_at_grid_end) {
    std::vector<PlannedRun> runs = hundred_runs(95, 5);
    for (int run = 0; run < num_at_grid_end; ++run) {
      runs[static_cast<std::size_t>(run)].sizes.front().num_at_grid_end = {0, 1};
    }
    return summary_of_runs(small(), runs);
  };
  EXPECT_EQ(summary_with(40).front().at_grid_end, (std::vector<double>{0.0, 0.1}));
  const auto doubts = planning_doubts(small(), summary_with(40), false);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(doubts.front().find("b: of 10 % of the participants the posterior of QUEST+"), 0U)
      << doubts.front();
  EXPECT_TRUE(planning_doubts(small(), summary_with(20), false).empty()) << "one in twenty";
}

TEST(PowerSummary, ATestThatFindsWhatIsNotThereIsADoubtUnderTheNullHypothesisAlone) {
  const auto doubts = [](int num_significant, bool null_hypothesis) {
    return planning_doubts(small(), summary_of_runs(small(), hundred_runs(95, num_significant)),
                           null_hypothesis);
  };
  ASSERT_EQ(doubts(27, true).size(), 1U);
  EXPECT_NE(doubts(27, true).front().find("in 27 % of the studies, not in 5 %"),
            std::string::npos);
  EXPECT_TRUE(doubts(27, false).empty()) << "that is power";
  EXPECT_TRUE(doubts(8, true).empty());
}

TEST(PowerSummary, WhereNothingDiffersTheShareIsTheRateOfFalsePositives) {
  PlannedAnalysis apart = small();
  EXPECT_FALSE(true_difference(apart)) << "that of b is not known";
  EXPECT_FALSE(nothing_differs(apart));
  apart.blocks[1].true_value = 0.6;
  EXPECT_NEAR(*true_difference(apart), std::log(std::log(1.3) / std::log(1.6)), 1e-15);
  EXPECT_FALSE(nothing_differs(apart));
  const auto doubts = [](const PlannedAnalysis& analysis, bool null_hypothesis,
                         int num_significant) {
    return planning_doubts(analysis,
                           summary_of_runs(analysis, hundred_runs(95, num_significant)),
                           null_hypothesis);
  };
  EXPECT_TRUE(doubts(apart, false, 3).empty());
  PlannedAnalysis alike = apart;
  alike.blocks[1].true_value = 0.3;
  EXPECT_TRUE(nothing_differs(alike));
  ASSERT_EQ(doubts(alike, false, 3).size(), 1U);
  EXPECT_NE(doubts(alike, false, 3).front().find("rate of false positives, not a power"),
            std::string::npos);
  EXPECT_TRUE(doubts(alike, true, 3).empty()) << "as asked for";
  EXPECT_EQ(doubts(alike, false, 27).size(), 2U) << "too many of them";
  alike.compared.reset();
  EXPECT_FALSE(nothing_differs(alike));
}

}  // namespace power_summary_test
}  // namespace jnd::analysis
