#include "experiments/adaptive/quest_plus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "core/error.h"
#include "core/psychometric_function.h"
#include "experiments/adaptive/level_scale.h"

namespace jnd::experiments {
namespace quest_plus_test {

/// A rule with two equally likely values. Each has its probability of "yes" at the intensities
/// 1, 2, 3 and 4. The second intensity tells the values apart at once, and so does the fourth.
QuestPlusRule two_values() {
  QuestPlusModel model;
  model.parameters = {{"which", {{1.0, 2.0}}, false}};
  model.probability = [](bool yes, double intensity, std::span<const double> values) {
    const double first[] = {0.5, 1.0, 0.75, 0.0};
    const double p = first[static_cast<int>(intensity) - 1];
    return (values[0] == 1.0) == yes ? p : 1.0 - p;
  };
  return {.model = model, .intensities = {1, 2, 3, 4}, .max_trials = 10};
}

QuestPlusRule weber_rule() {
  const auto grid = [](double low, double high, int count) {
    return equally_spaced(LevelScale::kLogarithmic, low, high, count);
  };
  return {.model = weber_model({.pse = {grid(1.0, 4.0, 25)},
                                .weber_fraction = {grid(0.1, 1.5, 15)},
                                .lapse_rate = {{0.0, 0.03}}}),
          .intensities = grid(0.7, 6.0, 25),
          .max_trials = 50};
}

core::RandomStream some_stream() { return {1, "quest_plus_test"}; }

/// Answers of an observer with this curve, each to the intensity that the rule asks for.
std::vector<LevelAnswer> run(const QuestPlus& quest, const core::PsychometricFunction& curve,
                             int seed) {
  core::RandomStream stream(seed, "quest_plus_test");
  QuestPlusPosterior posterior = quest.prior();
  std::vector<LevelAnswer> answers;
  while (quest.end(posterior) == QuestPlusEnd::kNotFinished) {
    const double level = quest.next_intensity(posterior, stream);
    answers.push_back({level, stream.with_probability(curve.probability(level))});
    quest.bring_up_to_date(posterior, answers);
  }
  return answers;
}

TEST(QuestPlus, IsWorkedByHandOnAGridOfTwo) {
  const QuestPlus quest(two_values());
  EXPECT_EQ(quest.entropy_bits(quest.prior()), 1.0);
  const Eigen::VectorXd information = quest.expected_information_bits(quest.prior());
  EXPECT_NEAR(information[0], 0.0, 1e-15);
  EXPECT_NEAR(information[1], 1.0, 1e-15);
  // The information is 1 - h(3/4), with h(3/4) = 2 - 3/4 log2 3.
  EXPECT_NEAR(information[2], 0.75 * std::log2(3.0) - 1.0, 1e-15);
  const auto posterior = quest.posterior({{3, true}});
  EXPECT_NEAR(posterior.probability[0], 0.75, 1e-15);
  EXPECT_NEAR(quest.posterior({{3, true}, {3, true}}).probability[0], 0.9, 1e-15);
  EXPECT_NEAR(quest.posterior({{3, true}, {3, false}}).probability[0], 0.5, 1e-15);
  EXPECT_NEAR(quest.estimates(posterior).at(0).mean, 1.25, 1e-15);
  EXPECT_NEAR(quest.estimates(posterior).at(0).sd, std::sqrt(0.1875), 1e-15);
}

TEST(QuestPlus, AsksForTheLowerOfTwoIntensitiesThatTellTheSame) {
  auto stream = some_stream();
  EXPECT_EQ(QuestPlus(two_values()).next_intensity(QuestPlus(two_values()).prior(), stream), 2);
  // With a curve that is symmetrical in ln about 1, the intensities x and 1/x tell the same but
  // for rounding.
  QuestPlusRule rule = weber_rule();
  rule.model = weber_model({.pse = {{0.8, 1.0, 1.25}}, .weber_fraction = {{0.2, 0.4}}});
  rule.intensities = {0.5, 0.7, 1.0 / 0.7, 2.0};
  const QuestPlus quest(rule);
  const Eigen::VectorXd information = quest.expected_information_bits(quest.prior());
  EXPECT_NEAR(information[1], information[2], 1e-13);
  EXPECT_EQ(quest.next_intensity(quest.prior(), stream), 0.7);
}

TEST(QuestPlus, DrawsAmongTheBestIfAsked) {
  QuestPlusRule rule = two_values();
  rule.num_best = 3;
  const QuestPlus quest(rule);
  auto stream = some_stream();
  std::map<double, int> drawn;
  for (int i = 0; i < 3000; ++i) ++drawn[quest.next_intensity(quest.prior(), stream)];
  ASSERT_EQ(drawn.size(), 3u);
  for (const double intensity : {2.0, 3.0, 4.0}) EXPECT_NEAR(drawn[intensity], 1000, 130);
}

TEST(QuestPlus, IsTheSameToTheBitBroughtUpToDateOrFromThePrior) {
  const QuestPlus quest(weber_rule());
  const auto answers = run(quest, {1.9, 0.4, 0.02}, 1);
  QuestPlusPosterior kept = quest.prior();
  for (std::size_t count = 1; count <= answers.size(); ++count) {
    const std::vector<LevelAnswer> so_far(answers.begin(), answers.begin() + count);
    quest.bring_up_to_date(kept, so_far);
    EXPECT_EQ(kept.probability, quest.posterior(so_far).probability);
    EXPECT_NEAR(kept.probability.sum(), 1.0, 1e-12);
  }
}

TEST(QuestPlus, ForgetsAnswersThatAreTakenBackOrCorrected) {
  const QuestPlus quest(weber_rule());
  auto answers = run(quest, {1.9, 0.4, 0.02}, 2);
  QuestPlusPosterior kept = quest.posterior(answers);
  answers.resize(20);
  quest.bring_up_to_date(kept, answers);
  EXPECT_EQ(kept.probability, quest.posterior(answers).probability);
  EXPECT_EQ(kept.answers, answers);
  answers[7].yes = !answers[7].yes;
  quest.bring_up_to_date(kept, answers);
  EXPECT_EQ(kept.probability, quest.posterior(answers).probability);
}

TEST(QuestPlus, TakesTheIntensityThatWasPresentedEvenOffItsGrid) {
  QuestPlusRule rule = weber_rule();
  const QuestPlus quest(rule);
  rule.intensities = {0.9, 1.234, 2.0};
  const QuestPlus with_it(rule);
  EXPECT_EQ(quest.posterior({{1.234, true}}).probability,
            with_it.posterior({{1.234, true}}).probability);
}

TEST(QuestPlus, WeighsItsGridsByTheirPriors) {
  QuestPlusRule rule = weber_rule();
  // The values lie one and two standard deviations off, so that their weights are e^-1/2 and
  // e^-2 beside 1.
  rule.model = weber_model({.pse = {{1.0, 2.0, 4.0}, LogNormalPrior{1.0, std::log(2.0)}},
                            .weber_fraction = {{0.2, 0.4}},
                            .lapse_rate = {{0.01}}});
  const QuestPlus quest(rule);
  const double sum = 1.0 + std::exp(-0.5) + std::exp(-2.0);
  const auto& prior = quest.prior().probability;
  ASSERT_EQ(prior.size(), 6);
  EXPECT_NEAR(prior[0], 0.5 / sum, 1e-15);
  EXPECT_NEAR(prior[1], 0.5 / sum, 1e-15);
  EXPECT_NEAR(prior[2], 0.5 * std::exp(-0.5) / sum, 1e-15);
  EXPECT_NEAR(prior[5], 0.5 * std::exp(-2.0) / sum, 1e-15);
  EXPECT_EQ(quest.values_at(5), (std::vector<double>{4.0, 0.4, 0.01}));
  // A prior far off its grid still has a sum.
  rule.model.parameters[0].grid.prior = LogNormalPrior{1e-30, 0.01};
  EXPECT_EQ(QuestPlus(rule).prior().probability[0], 0.5);
}

TEST(QuestPlus, HasTheCurvesThatItsHeaderSays) {
  const auto at = [](const QuestPlusModel& model, bool yes, double x,
                     std::vector<double> values) { return model.probability(yes, x, values); };
  const QuestPlusModel weber = weber_model({{{1.0}}, {{1.0}}});
  EXPECT_NEAR(at(weber, true, 2.6, {2.0, 0.3, 0.0}), 0.841344746068543, 1e-14);
  EXPECT_NEAR(at(weber, true, 2.6, {2.0, 0.3, 0.1}), 0.1 + 0.8 * 0.841344746068543, 1e-14);
  EXPECT_NEAR(at(weber, true, 0.0, {2.0, 0.3, 0.1}), 0.1, 1e-15);
  const ThresholdGrids grids = {{{1.0}}, {{1.0}}};
  EXPECT_NEAR(at(gauss_model(grids), true, 2.0, {2.0, 3.0, 0.5, 0.02}), 0.74, 1e-14);
  EXPECT_NEAR(at(gauss_model(grids), true, 2.0 * std::exp(0.5), {2.0, 2.0, 0.0, 0.0}),
              0.841344746068543, 1e-14);
  EXPECT_NEAR(at(weibull_model(grids), true, 2.0, {2.0, 3.0, 0.5, 0.02}),
              0.5 + 0.48 * (1.0 - std::exp(-1.0)), 1e-14);
  EXPECT_NEAR(at(weibull_model(grids), false, 4.0, {2.0, 2.0, 0.0, 0.0}), std::exp(-4.0),
              1e-16);
  // A very unlikely "no" is not lost beside 1.
  EXPECT_NEAR(at(weber, false, 20.0, {2.0, 0.3, 0.0}) / 8.44772704146593e-19, 1.0, 1e-10);
}

TEST(QuestPlus, EndsAfterTrialsOrAtAnEntropyOrAStandardDeviation) {
  QuestPlusRule rule = two_values();
  rule.max_trials = 3;
  const auto end_after = [&](const std::vector<LevelAnswer>& answers) {
    const QuestPlus quest(rule);
    return quest.end(quest.posterior(answers));
  };
  EXPECT_EQ(end_after({{1, true}, {1, true}}), QuestPlusEnd::kNotFinished);
  EXPECT_EQ(end_after({{1, true}, {1, true}, {1, true}}), QuestPlusEnd::kTrials);
  rule.entropy_bits = 0.5;
  EXPECT_EQ(end_after({{3, true}}), QuestPlusEnd::kNotFinished);         // 0.81 bits are left.
  EXPECT_EQ(end_after({{3, true}, {3, true}}), QuestPlusEnd::kEntropy);  // 0.47 bits are left.
  EXPECT_EQ(end_after({{2, true}}), QuestPlusEnd::kEntropy);
  rule.min_trials = 2;
  EXPECT_EQ(end_after({{2, true}}), QuestPlusEnd::kNotFinished);
  rule.min_trials = 0;
  rule.entropy_bits.reset();
  rule.marginal = {"which", 0.4};
  // The standard deviation is 0.43.
  EXPECT_EQ(end_after({{3, true}}), QuestPlusEnd::kNotFinished);
  // The standard deviation is 0.3.
  EXPECT_EQ(end_after({{3, true}, {3, true}}), QuestPlusEnd::kMarginal);
}

TEST(QuestPlus, RecoversAKnownObserverWithoutBiasOver200Runs) {
  const core::PsychometricFunction observer = {1.9, 0.4, 0.02};
  const QuestPlus quest(weber_rule());
  constexpr int kNumRuns = 200;
  double pse_sum = 0.0, pse_squares = 0.0, weber_sum = 0.0, weber_squares = 0.0;
  int num_holding_pse = 0, num_holding_weber = 0;
  for (int i = 0; i < kNumRuns; ++i) {
    const auto estimates = quest.estimates(quest.posterior(run(quest, observer, i)));
    const double pse = std::log(estimates[0].mean / observer.pse);
    const double weber = std::log(estimates[1].mean / observer.weber_fraction);
    pse_sum += pse, pse_squares += pse * pse;
    weber_sum += weber, weber_squares += weber * weber;
    num_holding_pse += estimates[0].low <= observer.pse && estimates[0].high >= observer.pse;
    num_holding_weber += estimates[1].low <= observer.weber_fraction &&
                         estimates[1].high >= observer.weber_fraction;
  }
  // The biases are in ln; their standard errors are 0.006 and 0.02.
  EXPECT_NEAR(pse_sum / kNumRuns, 0.0, 0.02);
  EXPECT_NEAR(weber_sum / kNumRuns, 0.0, 0.08);
  EXPECT_LT(std::sqrt(pse_squares / kNumRuns), 0.09);
  EXPECT_LT(std::sqrt(weber_squares / kNumRuns), 0.4);
  EXPECT_GE(num_holding_pse, 180);
  EXPECT_GE(num_holding_weber, 180);
}

TEST(QuestPlus, KnowsAllAboutAGridOfOnePoint) {
  QuestPlusRule rule = weber_rule();
  rule.model = weber_model({{{2.0}}, {{0.3}}, {{0.02}}});
  rule.entropy_bits = 0.0;
  const QuestPlus quest(rule);
  auto stream = some_stream();
  EXPECT_EQ(quest.entropy_bits(quest.prior()), 0.0);
  EXPECT_TRUE(quest.expected_information_bits(quest.prior()).isZero(1e-15));
  EXPECT_EQ(quest.next_intensity(quest.prior(), stream), rule.intensities.front());
  EXPECT_EQ(quest.end(quest.prior()), QuestPlusEnd::kEntropy);
  const auto estimate = quest.estimates(quest.posterior({{5.0, false}})).at(0);
  EXPECT_EQ(estimate.mean, 2.0);
  EXPECT_EQ(estimate.sd, 0.0);
  EXPECT_EQ(estimate.low, 2.0);
  EXPECT_EQ(estimate.high, 2.0);
}

TEST(QuestPlus, SaysThatAnswersAreImpossibleAndKeepsWhatItHad) {
  QuestPlusRule rule = weber_rule();
  rule.model = weber_model({{{1.9, 2.0}}, {{0.001}}, {{0.0}}});
  const QuestPlus quest(rule);
  QuestPlusPosterior posterior = quest.posterior({{4.0, true}});
  const Eigen::VectorXd before = posterior.probability;
  try {
    quest.bring_up_to_date(posterior, {{4.0, true}, {0.5, true}});
    FAIL() << "expected an error";
  } catch (const core::Error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("allow lapses"));
  }
  EXPECT_EQ(posterior.answers.size(), 1u);
  EXPECT_EQ(posterior.probability, before);
  EXPECT_THROW((void)quest.posterior({{-1.0, true}}), core::Error);
  EXPECT_THROW((void)quest.posterior({{std::nan(""), true}}), core::Error);
}

TEST(QuestPlusEstimate, HasAnIntervalThatHoldsIt) {
  const QuestPlusParameter parameter = {"pse", {{1.0, 2.0, 4.0, 8.0, 16.0}}, true};
  const auto usual = estimate_of(parameter, {0.02, 0.1, 0.76, 0.1, 0.02}, 0.95);
  EXPECT_NEAR(usual.mean, 4.0, 1e-12);
  EXPECT_EQ(usual.low, 2.0);
  EXPECT_EQ(usual.high, 8.0);
  EXPECT_EQ(estimate_of(parameter, {0.03, 0.1, 0.74, 0.1, 0.03}, 0.95).low, 1.0);
  EXPECT_EQ(estimate_of(parameter, {0.03, 0.1, 0.74, 0.1, 0.03}, 0.95).high, 16.0);
  const auto coarse = estimate_of(parameter, {0.99, 0.0, 0.0, 0.0, 0.01}, 0.95);
  EXPECT_EQ(coarse.low, 1.0);
  EXPECT_EQ(coarse.high, coarse.mean);
  EXPECT_GT(coarse.mean, 1.0);
  const auto mirrored = estimate_of(parameter, {0.01, 0.0, 0.0, 0.0, 0.99}, 0.95);
  EXPECT_EQ(mirrored.low, mirrored.mean);
  EXPECT_LT(mirrored.mean, 16.0);
}

TEST(QuestPlusEstimate, ReachesAnEndWhereANormalPosteriorWouldEndItsInterval) {
  // The posterior is normal about 0 with a standard deviation of 1. The interval reaches a
  // grid's end at -1.9, but not one at -2.1.
  for (const int count : {10, 40, 400}) {
    for (const double least : {-1.9, -2.1}) {
      const std::vector<double> values = equally_spaced(LevelScale::kLinear, least, 4.0, count);
      std::vector<double> weights;
      double sum = 0.0;
      for (const double value : values) sum += std::exp(-0.5 * value * value);
      for (const double value : values) weights.push_back(std::exp(-0.5 * value * value) / sum);
      const QuestPlusEstimate found = estimate_of({"shift", {values}, false}, weights, 0.95);
      EXPECT_EQ(found.reached_low.has_value(), least > -1.96 || count == 10)
          << count << " values from " << least << "; few are each of much weight";
      EXPECT_FALSE(found.reached_high.has_value()) << count;
    }
  }
  const QuestPlusEstimate flat = estimate_of({"shift", {{1.0, 2.0}}, false}, {0.5, 0.5}, 0.95);
  EXPECT_EQ(flat.reached_low, 1.0) << "before the first answer";
  EXPECT_EQ(flat.reached_high, 2.0);
  EXPECT_TRUE(flat.reaches_an_end());
}

TEST(QuestPlus, RefusesARuleThatCannotRun) {
  const auto refused = [](const std::function<void(QuestPlusRule&)>& spoil) {
    QuestPlusRule rule = weber_rule();
    spoil(rule);
    EXPECT_THROW(QuestPlus{rule}, core::Error);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& r) { r.model = {}; });
  refused([](auto& r) { r.model.parameters[0].grid.values = {}; });
  refused([](auto& r) { r.model.parameters[0].grid.values = {2.0, 1.0}; });
  refused([](auto& r) { r.model.parameters[0].grid.prior = LogNormalPrior{0.0, 1.0}; });
  refused([](auto& r) { r.model.parameters[0].grid.prior = LogNormalPrior{1.0, 0.0}; });
  // This grid holds 0.
  refused([](auto& r) { r.model.parameters[2].grid.prior = LogNormalPrior{}; });
  refused([&](auto& r) { r.model.probability = [=](auto...) { return nan; }; });
  refused([](auto& r) { r.model.probability = [](auto...) { return 0.6; }; });
  refused([](auto& r) { r.intensities = {}; });
  refused([](auto& r) { r.intensities = {-1.0, 1.0}; });
  refused([](auto& r) { r.intensities = {1.0, 1.0}; });
  refused([](auto& r) { r.num_best = 0; });
  refused([](auto& r) { r.num_best = 26; });
  refused([](auto& r) { r.max_trials = 0; });
  refused([](auto& r) { r.min_trials = -1; });
  refused([&](auto& r) { r.entropy_bits = nan; });
  refused([](auto& r) { r.marginal = {"pse", 0.0}; });
  refused([](auto& r) { r.marginal = {"slope", 0.1}; });
  EXPECT_THROW((void)weber_model({{{0.0}}, {{0.3}}}), core::Error);
  EXPECT_THROW((void)weber_model({{{1.0}}, {{nan}}}), core::Error);
  EXPECT_THROW((void)weber_model({{{1.0}}, {{0.3}}, {{0.5}}}), core::Error);
  EXPECT_THROW((void)gauss_model({{{1.0}}, {{0.3}}, {{-0.1}}}), core::Error);
  EXPECT_THROW((void)weibull_model({{{1.0}}, {{0.3}}, {{0.6}}, {{0.4}}}), core::Error);
  const QuestPlus quest(weber_rule());
  EXPECT_THROW((void)quest.estimates(quest.prior(), 1.0), core::Error);
}

}  // namespace quest_plus_test
}  // namespace jnd::experiments
