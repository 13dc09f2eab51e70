#include "analysis/planning/power_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statistics/comparison.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "support/sanitizer.h"

namespace jnd::analysis {
namespace power_run_test {

PlannedAnswers answers(double weber_fraction, double pse, core::RandomStream& random) {
  PlannedAnswers one;
  const core::PsychometricFunction curve{.pse = pse, .weber_fraction = weber_fraction};
  for (const double x : {0.6, 0.7, 0.85, 0.95, 1.05, 1.2, 1.45, 1.8}) {
    AnswerCount count{.intensity = x, .num_trials = 5};
    for (int trial = 0; trial < 5; ++trial) {
      count.num_yes += random.with_probability(curve.probability(x)) ? 1 : 0;
    }
    one.counts.push_back(count);
  }
  return one;
}

PlannedAnalysis two_blocks() {
  return {.blocks = {{.name = "a", .reference = 1.0, .true_value = 0.25},
                     {.name = "b", .reference = 1.0, .true_value = 0.25}},
          .compared = std::pair(0, 1),
          .sizes = {3, 6}};
}

std::vector<PlannedPerson> people(int count, double first_w, double second_w,
                                  std::uint64_t seed) {
  core::RandomStream random(seed, "people");
  std::vector<PlannedPerson> all;
  for (int i = 0; i < count; ++i) {
    const double own = std::exp(0.2 * random.normal());
    all.push_back({answers(own * first_w, 1.0, random), answers(own * second_w, 1.0, random)});
  }
  return all;
}

double own_log_log(const PlannedAnswers& one) {
  const auto fit = fit_psychometric(one.counts, {.reference = 1.0, .free_pse = true});
  return std::log(std::log1p(fit.weber_fraction.value()));
}

TEST(PowerRun, IsTheTestOfTheIndividualFitsThatTheResultsPrint) {
  const std::vector<PlannedPerson> everybody = people(6, 0.5, 0.3, 2);
  const PlannedRun run = analyse_run(two_blocks(), everybody);
  ASSERT_EQ(run.sizes.size(), 2U);
  for (const auto& [size, count] : {std::pair(0, 3), std::pair(1, 6)}) {
    std::vector<double> a, b;
    for (int person = 0; person < count; ++person) {
      a.push_back(own_log_log(everybody[static_cast<std::size_t>(person)][0]));
      b.push_back(own_log_log(everybody[static_cast<std::size_t>(person)][1]));
    }
    const Comparison expected = paired_t_test(a, b);
    const PlannedSize& found = run.sizes[static_cast<std::size_t>(size)];
    EXPECT_NEAR(*found.tests[0].p_value, *expected.p_value, 1e-9);
    EXPECT_NEAR(*found.tests[0].difference, *expected.estimate, 1e-9);
    double mean = 0.0;
    for (const double value : a) mean += value / count;
    EXPECT_NEAR(*found.estimates[0].value, std::expm1(std::exp(mean)), 1e-9);
    EXPECT_LT(*found.estimates[0].ci95.low, *found.estimates[0].value);
    EXPECT_GT(*found.estimates[0].ci95.high, *found.estimates[0].value);
  }
}

TEST(PowerRun, AStudyOfFewIsTheFirstOfMany) {
  std::vector<PlannedPerson> everybody = people(6, 0.5, 0.3, 3);
  const PlannedRun both = analyse_run(two_blocks(), everybody);
  PlannedAnalysis few = two_blocks();
  few.sizes = {3};
  everybody.resize(3);
  const PlannedRun alone = analyse_run(few, everybody);
  EXPECT_EQ(*alone.sizes[0].tests[0].p_value, *both.sizes[0].tests[0].p_value);
  EXPECT_EQ(*alone.sizes[0].estimates[1].value, *both.sizes[0].estimates[1].value);
}

TEST(PowerRun, WhoSeparatesTheStimuliPerfectlyIsLeftOutOrGivenHalfAnAnswer) {
  std::vector<PlannedPerson> everybody = people(6, 0.5, 0.3, 2);
  for (AnswerCount& count : everybody[1][0].counts) {
    count.num_yes = count.intensity > 1.0 ? count.num_trials : 0;
  }
  const PlannedRun run = analyse_run(two_blocks(), everybody);
  EXPECT_EQ(run.sizes[1].num_degenerate, (std::vector<int>{1, 0}));
  EXPECT_EQ(run.sizes[1].num_with_answers, (std::vector<int>{6, 6}));
  // Only the first test leaves this person out, and with the person the whole pair.
  std::vector<PlannedPerson> without = everybody;
  without.erase(without.begin() + 1);
  PlannedAnalysis five = two_blocks();
  five.sizes = {5};
  const PlannedRun others = analyse_run(five, without);
  EXPECT_EQ(*run.sizes[1].tests[0].p_value, *others.sizes[0].tests[0].p_value);
  EXPECT_NE(*run.sizes[1].tests[1].p_value, *others.sizes[0].tests[1].p_value);
}

TEST(PowerRun, FalsePositivesAreFivePercentWhereBothBlocksAreAlike) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  constexpr int kRuns = 1000;
  int num_significant = 0, num_corrected = 0;
  PlannedAnalysis planned = two_blocks();
  planned.sizes = {13};
  for (int run = 0; run < kRuns; ++run) {
    const PlannedRun outcome =
        analyse_run(planned, people(13, 0.25, 0.25, static_cast<std::uint64_t>(1000 + run)));
    num_significant += *outcome.sizes[0].tests[0].p_value < 0.05 ? 1 : 0;
    num_corrected += *outcome.sizes[0].tests[1].p_value < 0.05 ? 1 : 0;
  }
  // With 1000 runs, 5 % with three standard deviations is 50 +- 20.7.
  EXPECT_NEAR(num_significant, 50, 20);
  EXPECT_NEAR(num_corrected, 50, 20);
}

TEST(PowerRun, ExponentsAreMeansOfLinesThroughLogarithms) {
  const PlannedAnalysis planned{
      .blocks = {{.name = "me", .quantity = PlannedQuantity::kEstimationExponent},
                 {.name = "mp", .quantity = PlannedQuantity::kProductionExponent}},
      .sizes = {2}};
  // S = I^0.5 and I^0.7. In production, I is set for S as S^0.4 and S^0.6, so on average S^0.5
  // = I.
  std::vector<PlannedPerson> everybody(2);
  for (std::size_t i = 0; i < 2; ++i) {
    everybody[i].resize(2);
    for (const double x : {1.0, 2.0, 4.0}) {
      everybody[i][0].magnitudes[x] = {std::pow(x, i == 0 ? 0.5 : 0.7)};
      everybody[i][1].magnitudes[100.0 * x] = {std::pow(x, i == 0 ? 0.4 : 0.6)};
    }
  }
  const PlannedRun run = analyse_run(planned, everybody);
  EXPECT_NEAR(*run.sizes[0].estimates[0].value, 0.6, 1e-12);
  EXPECT_NEAR(*run.sizes[0].estimates[1].value, 2.0, 1e-12);
  // Student's t with one degree of freedom is 12.7062, and the error is 0.1414 / sqrt 2 = 0.1.
  EXPECT_NEAR(*run.sizes[0].estimates[0].ci95.high, 0.6 + 1.27062, 1e-5);
  EXPECT_NEAR(*run.sizes[0].estimates[1].ci95.low, 1.0 / (0.5 + 1.27062), 1e-5);
  EXPECT_FALSE(run.sizes[0].estimates[1].ci95.high) << "open: a slope of 0 is in the interval";
  EXPECT_TRUE(run.sizes[0].tests.empty());
}

TEST(PowerRun, WhereNobodyGetsBothBlocksTheTestIsUnpaired) {
  std::vector<PlannedPerson> everybody = people(6, 0.5, 0.3, 2);
  for (std::size_t i = 0; i < 6; ++i) everybody[i][i % 2].counts.clear();
  PlannedAnalysis planned = two_blocks();
  planned.paired = false;
  const PlannedRun run = analyse_run(planned, everybody);
  EXPECT_EQ(run.sizes[1].num_with_answers, (std::vector<int>{3, 3}));
  const Comparison expected =
      welch_t_test({own_log_log(everybody[1][0]), own_log_log(everybody[3][0]),
                    own_log_log(everybody[5][0])},
                   {own_log_log(everybody[0][1]), own_log_log(everybody[2][1]),
                    own_log_log(everybody[4][1])});
  EXPECT_NEAR(*run.sizes[1].tests[0].p_value, *expected.p_value, 1e-9);
}

PowerContrast contrast_of(std::vector<std::vector<std::size_t>> conditions,
                          std::vector<std::vector<double>> weights) {
  PowerContrast contrast{.name = "planned", .family = "primary"};
  contrast.conditions = std::move(conditions);
  contrast.groups = std::vector<experiments::Levels>(weights.size());
  contrast.weights = std::move(weights);
  return contrast;
}

TEST(PowerRun, APlannedContrastOfTwoBlocksIsThePairedTest) {
  PlannedAnalysis analysis = two_blocks();
  analysis.contrasts = {contrast_of({{0}, {1}}, {{1.0, -1.0}})};
  ASSERT_EQ(test_names(analysis).size(), 3U);
  EXPECT_TRUE(test_names(analysis).back().of_contrast);
  const PlannedRun run = analyse_run(analysis, people(6, 0.5, 0.3, 2));
  for (const PlannedSize& size : run.sizes) {
    ASSERT_EQ(size.tests.size(), 3U);
    ASSERT_EQ(size.num_degenerate, (std::vector<int>{0, 0})) << "both tests have everybody";
    EXPECT_NEAR(*size.tests[2].difference, *size.tests[0].difference, 1e-9);
    EXPECT_NEAR(*size.tests[2].p_value, *size.tests[0].p_value, 1e-9);
  }
}

TEST(PowerRun, BlocksOfOneConditionAreTakenTogether) {
  PlannedAnalysis pooled = two_blocks();
  pooled.compared.reset();
  pooled.blocks.push_back({.name = "c", .reference = 1.0});
  pooled.contrasts = {contrast_of({{0, 2}, {1}}, {{1.0, -1.0}})};
  std::vector<PlannedPerson> everybody = people(6, 0.5, 0.3, 2);
  std::vector<PlannedPerson> doubled = everybody;
  for (std::size_t person = 0; person < everybody.size(); ++person) {
    everybody[person].push_back(everybody[person][0]);
    for (AnswerCount& count : doubled[person][0].counts) {
      count.num_yes *= 2;
      count.num_trials *= 2;
    }
  }
  PlannedAnalysis alone = two_blocks();
  alone.compared.reset();
  alone.contrasts = {contrast_of({{0}, {1}}, {{1.0, -1.0}})};
  const PlannedRun of_three = analyse_run(pooled, everybody);
  const PlannedRun of_two = analyse_run(alone, doubled);
  EXPECT_NEAR(*of_three.sizes[1].tests[0].difference, *of_two.sizes[1].tests[0].difference,
              1e-9);
  EXPECT_NEAR(*of_three.sizes[1].tests[0].p_value, *of_two.sizes[1].tests[0].p_value, 1e-9);
}

TEST(PowerRun, GroupsOfAContrastAreThoseOfTheirLevels) {
  PlannedAnalysis analysis = two_blocks();
  analysis.compared.reset();
  analysis.contrasts = {contrast_of({{0}}, {{1.0}, {-1.0}})};
  analysis.contrasts[0].groups = {{{"priming", "primed"}}, {{"priming", "control"}}};
  const std::vector<PlannedPerson> everybody = people(6, 0.5, 0.3, 2);
  std::vector<experiments::Levels> levels;
  std::vector<double> primed, control;
  for (std::size_t person = 0; person < everybody.size(); ++person) {
    const bool is_primed = person % 2 == 0;
    levels.push_back({{"priming", is_primed ? "primed" : "control"}});
    (is_primed ? primed : control).push_back(own_log_log(everybody[person][0]));
  }
  const PlannedTest test = analyse_run(analysis, everybody, levels).sizes[1].tests.at(0);
  const Comparison expected = welch_t_test(primed, control);
  EXPECT_NEAR(*test.difference, *expected.estimate, 1e-9);
  EXPECT_NEAR(*test.p_value, *expected.p_value, 1e-9);
}

TEST(PowerRun, AFamilyIsAdjustedAndEquivalenceIsItsOwnTest) {
  PlannedAnalysis analysis = two_blocks();
  analysis.compared.reset();
  const PowerContrast one = contrast_of({{0}, {1}}, {{1.0, -1.0}});
  analysis.contrasts = {one};
  const PlannedRun alone = analyse_run(analysis, people(6, 0.5, 0.3, 2));
  analysis.contrasts = {one, one};
  analysis.contrasts[1].margin = 3.0;
  const PlannedRun both = analyse_run(analysis, people(6, 0.5, 0.3, 2));
  ASSERT_EQ(both.sizes[1].tests.size(), 3U);
  EXPECT_NEAR(*both.sizes[1].tests[0].p_value, 2.0 * *alone.sizes[1].tests[0].p_value, 1e-12);
  EXPECT_LT(*both.sizes[1].tests[2].p_value, 0.05) << "well within so wide a margin";
  EXPECT_EQ(test_names(analysis).back().name, "planned: equivalence");
}

TEST(PowerRun, LooksAreAtTheContrastThatTheyName) {
  PlannedAnalysis analysis = two_blocks();
  analysis.compared.reset();
  analysis.contrasts = {contrast_of({{0}, {1}}, {{1.0, -1.0}}),
                        contrast_of({{1}, {0}}, {{1.0, -1.0}})};
  analysis.contrasts[1].name = "decides";
  const std::vector<PlannedPerson> everybody = people(8, 0.5, 0.3, 2);
  EXPECT_FALSE(analyse_run(analysis, everybody).sequential);
  analysis.sequential = PlannedSequential{
      .contrast = "decides",
      .boundaries = boundaries_of({.looks = {4, 8}, .alpha = 0.4, .tail = Tail::kGreater})};
  EXPECT_EQ(analysis.num_people(), 8) << "more than the sizes ask for";
  const PlannedRun less = analyse_run(analysis, everybody);
  ASSERT_TRUE(less.sequential);
  EXPECT_FALSE(less.sequential->significant) << "the second block has less, not more";
  analysis.sequential->contrast = "planned";
  EXPECT_TRUE(analyse_run(analysis, everybody).sequential->significant);
}

}  // namespace power_run_test
}  // namespace jnd::analysis
