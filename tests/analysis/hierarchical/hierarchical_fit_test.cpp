#include "analysis/hierarchical/hierarchical_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"
#include "support/sanitizer.h"

namespace jnd::analysis {
namespace hierarchical_fit_test {

constexpr HierarchicalOptions kWithoutLapses = {.lapses = HierarchicalLapses::kNone};
constexpr HierarchicalOptions kAtReference = {.pse = HierarchicalPse::kReference,
                                              .lapses = HierarchicalLapses::kNone};

/// Returns answers that are as close to the curve's probabilities as whole numbers allow.
ParticipantAnswers exact_answers(const std::string& participant, double w, double pse,
                                 std::int64_t num_trials, const std::string& condition = "") {
  ParticipantAnswers one{participant, condition, 1.0, {}};
  for (const double x : {0.5, 0.7, 0.9, 1.1, 1.4, 2.0}) {
    const double p = core::standard_normal_cdf(std::log(x / pse) / std::log1p(w));
    one.rows.push_back({x, std::llround(p * static_cast<double>(num_trials)), num_trials});
  }
  return one;
}

std::vector<ParticipantAnswers> differing_people(std::int64_t num_trials) {
  std::vector<ParticipantAnswers> all;
  int number = 0;
  for (const double factor : {0.5, 0.7, 0.85, 1.0, 1.2, 1.45, 2.0}) {
    all.push_back(exact_answers("P" + std::to_string(++number),
                                std::expm1(factor * std::log(1.5)), 1.0, num_trials));
  }
  return all;
}

TEST(HierarchicalFit, PeopleWhoDoNotDifferGiveTheirCommonCurveAndASpreadOfNothing) {
  std::vector<ParticipantAnswers> all;
  for (const char* name : {"P1", "P2", "P3", "P4", "P5"}) {
    all.push_back(exact_answers(name, 0.5, 1.1, 2000));
  }
  const HierarchicalFit fit = fit_hierarchical(
      all, {.pse = HierarchicalPse::kCommon, .lapses = HierarchicalLapses::kNone});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.conditions[0].weber_fraction, 0.5, 1e-3);
  EXPECT_NEAR(*fit.conditions[0].pse, 1.1, 1e-3);
  EXPECT_NEAR(fit.conditions[0].slope_sd, 0.0, 1e-4);
  EXPECT_NE(fit.note, "");
}

TEST(HierarchicalFit, TheMedianPersonIsTheMiddleOfPeopleWhoDifferByFactors) {
  // The logarithms of the factors are symmetric about ln 1, except 0.85 and 1.2, which nearly
  // are.
  const HierarchicalFit fit = fit_hierarchical(differing_people(4000), kAtReference);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.conditions[0].weber_fraction, 0.5, 0.01);
  // With this many answers, the spread is that of the seven values, divided by n as in the
  // likelihood.
  EXPECT_NEAR(fit.conditions[0].slope_sd, 0.4285, 0.002);
}

TEST(HierarchicalFit, ThePooledCurveIsFlatterThanTheMedianPerson) {
  const std::vector<ParticipantAnswers> all = differing_people(4000);
  std::vector<AnswerCount> pooled;
  for (const ParticipantAnswers& one : all) {
    pooled.insert(pooled.end(), one.rows.begin(), one.rows.end());
  }
  const PsychometricFit curve = fit_psychometric(pooled, {.reference = 1.0});
  const HierarchicalFit fit = fit_hierarchical(all, kAtReference);
  EXPECT_GT(*curve.weber_fraction, 1.02 * *fit.conditions[0].weber_fraction);
  // An interval that allows for differences between people is wider than that of pooled
  // answers.
  const Interval& group = fit.conditions[0].weber_fraction_ci95;
  EXPECT_GT(*group.high - *group.low,
            3.0 * (*curve.weber_fraction_ci95.high - *curve.weber_fraction_ci95.low));
}

TEST(HierarchicalFit, AnIntervalHoldsItsEstimate) {
  for (const HierarchicalPse pse : {HierarchicalPse::kReference, HierarchicalPse::kPersonal}) {
    const HierarchicalFit fit = fit_hierarchical(
        differing_people(10), {.pse = pse, .lapses = HierarchicalLapses::kNone});
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    const HierarchicalCondition& one = fit.conditions[0];
    EXPECT_LT(*one.weber_fraction_ci95.low, *one.weber_fraction);
    EXPECT_GT(*one.weber_fraction_ci95.high, *one.weber_fraction);
  }
}

TEST(HierarchicalFit, AParticipantWithoutAFitOfTheirOwnTakesPart) {
  std::vector<ParticipantAnswers> all = differing_people(10);
  ParticipantAnswers perfect = exact_answers("P8", 0.5, 1.0, 10);
  for (AnswerCount& row : perfect.rows) row.num_yes = row.intensity > 1.0 ? 10 : 0;
  ASSERT_EQ(fit_psychometric(perfect.rows, {.reference = 1.0}).status, FitStatus::kDegenerate);
  const HierarchicalFit without = fit_hierarchical(all, kAtReference);
  all.push_back(perfect);
  const HierarchicalFit with = fit_hierarchical(all, kAtReference);
  ASSERT_EQ(with.status, FitStatus::kOk) << with.reason;
  EXPECT_LT(*with.conditions[0].weber_fraction, *without.conditions[0].weber_fraction);
  ASSERT_EQ(with.participants.size(), 8U);
  EXPECT_GT(*with.participants[7].weber_fraction, 0.0);
}

TEST(HierarchicalFit, TheOrderOfParticipantsDoesNotMatter) {
  std::vector<ParticipantAnswers> all = differing_people(10);
  const HierarchicalFit one = fit_hierarchical(all, kWithoutLapses);
  std::reverse(all.begin(), all.end());
  const HierarchicalFit other = fit_hierarchical(all, kWithoutLapses);
  EXPECT_NEAR(*one.conditions[0].weber_fraction, *other.conditions[0].weber_fraction, 1e-7);
}

TEST(HierarchicalFit, AUnitOfTheIntensitiesDoesNotMatter) {
  std::vector<ParticipantAnswers> all = differing_people(10);
  const HierarchicalFit one = fit_hierarchical(all, kWithoutLapses);
  for (ParticipantAnswers& answers : all) {
    answers.reference *= 1000.0;
    for (AnswerCount& row : answers.rows) row.intensity *= 1000.0;
  }
  const HierarchicalFit other = fit_hierarchical(all, kWithoutLapses);
  EXPECT_NEAR(*one.conditions[0].weber_fraction, *other.conditions[0].weber_fraction, 1e-7);
  EXPECT_NEAR(*other.conditions[0].pse, 1000.0 * *one.conditions[0].pse, 1e-4);
}

TEST(HierarchicalFit, TwoConditionsDifferByWhatTheirCurvesDo) {
  std::vector<ParticipantAnswers> all;
  int number = 0;
  for (const double factor : {0.6, 0.8, 1.0, 1.25, 1.6}) {
    const std::string name = "P" + std::to_string(++number);
    all.push_back(exact_answers(name, std::expm1(factor * 0.5), 1.0, 500, "d"));
    all.push_back(exact_answers(name, std::expm1(factor * 0.25), 1.0, 500, "e"));
  }
  const HierarchicalFit fit = fit_hierarchical(all, kAtReference);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  ASSERT_EQ(fit.differences.size(), 1U);
  EXPECT_EQ(fit.differences[0].second, "e");
  EXPECT_NEAR(fit.differences[0].estimate, std::log(0.5), 0.03);
  EXPECT_EQ(fit.differences[0].degrees_of_freedom, 4.0);
  EXPECT_LT(*fit.differences[0].p_value, 0.001);
  EXPECT_GT(*fit.correlation, 0.95);
}

/// Returns people whose pses differ much in one condition and not at all in the other.
std::vector<ParticipantAnswers> people_with_a_bias_in_one_condition(std::int64_t num_trials) {
  std::vector<ParticipantAnswers> all;
  int number = 0;
  for (const double pse : {0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.43}) {
    const std::string name = "P" + std::to_string(++number);
    const double w = std::expm1(std::log(1.5) * (number % 2 == 0 ? 1.1 : 0.9));
    all.push_back(exact_answers(name, w, pse, num_trials, "biased"));
    all.push_back(exact_answers(name, w, 1.0, num_trials, "fair"));
  }
  return all;
}

TEST(HierarchicalFit, APersonMayBeBiasedInOneConditionAndNotInTheOther) {
  const auto answers = people_with_a_bias_in_one_condition(2000);
  const HierarchicalFit own = fit_hierarchical(answers, kWithoutLapses);
  ASSERT_EQ(own.status, FitStatus::kOk) << own.reason;
  EXPECT_NEAR(own.conditions[0].place_sd, 0.2329, 0.002) << "of the seven, over n";
  EXPECT_NEAR(own.conditions[1].place_sd, 0.0, 1e-3);
  EXPECT_NEAR(*own.conditions[0].weber_fraction, *own.conditions[1].weber_fraction, 0.02);
  const HierarchicalFit shared = fit_hierarchical(
      answers, {.pse = HierarchicalPse::kShared, .lapses = HierarchicalLapses::kNone});
  ASSERT_EQ(shared.status, FitStatus::kOk) << shared.reason;
  EXPECT_EQ(shared.conditions[0].place_sd, shared.conditions[1].place_sd);
  EXPECT_GT(*own.log_likelihood, *shared.log_likelihood + 100.0);
}

TEST(HierarchicalFit, TheUsualNumberOfNodesIsEnough) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  std::vector<ParticipantAnswers> answers = people_with_a_bias_in_one_condition(5);
  const HierarchicalFit usual = fit_hierarchical(answers, kWithoutLapses);
  const HierarchicalFit many =
      fit_hierarchical(answers, {.lapses = HierarchicalLapses::kNone, .num_nodes = 9});
  ASSERT_EQ(many.status, FitStatus::kOk) << many.reason;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(
        std::log(*usual.conditions[i].weber_fraction / *many.conditions[i].weber_fraction), 0.0,
        0.1 * *many.conditions[i].slope_standard_error);
  }
  EXPECT_NEAR(usual.differences[0].estimate, many.differences[0].estimate,
              0.1 * *many.differences[0].standard_error);
}

TEST(HierarchicalFit, ADifferenceCanBeReckonedAgainFromWhatIsTold) {
  const HierarchicalFit fit =
      fit_hierarchical(people_with_a_bias_in_one_condition(20), kWithoutLapses);
  ASSERT_EQ(fit.differences.size(), 1U);
  const HierarchicalDifference& one = fit.differences[0];
  EXPECT_NEAR(*one.statistic, one.estimate / *one.standard_error, 1e-12);
  EXPECT_NEAR(*one.ci95.high - one.estimate, 2.4469118511449692 * *one.standard_error, 1e-9)
      << "Student's t with 6 degrees of freedom";
}

/// Returns people whose ln ln(1 + w) differ between two conditions by ln of `factors`.
std::vector<ParticipantAnswers> people_with_differences(const std::vector<double>& factors,
                                                        std::int64_t num_trials) {
  std::vector<ParticipantAnswers> all;
  for (const double factor : factors) {
    const std::string name = "P" + std::to_string(all.size());
    const double first = 0.4 + 0.02 * static_cast<double>(all.size() % 3);
    all.push_back(exact_answers(name, std::expm1(first), 1.0, num_trials, "d"));
    all.push_back(exact_answers(name, std::expm1(first * factor), 1.0, num_trials, "e"));
  }
  return all;
}

TEST(HierarchicalFit, WithManyAnswersADifferenceIsThatOfThePairedTTest) {
  const std::vector<double> factors = {0.6, 0.9, 0.7, 1.1, 0.8, 0.65};
  const HierarchicalFit fit =
      fit_hierarchical(people_with_differences(factors, 20000), kAtReference);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  // The mean of ln of the factors, and their sd (n - 1) divided by the root of six, worked out
  // by hand.
  EXPECT_NEAR(fit.differences[0].estimate, -0.255246, 1e-3);
  EXPECT_NEAR(*fit.differences[0].standard_error, 0.091798, 1e-3);
}

TEST(HierarchicalFit, ADifferenceMayBeSurerThanAnswersByChanceWouldLeaveIt) {
  // These people differ by less than the chance of twelve answers a level. By chance alone, a
  // difference has the error of a condition times the root of two, and a paired t test finds
  // less.
  const std::vector<double> factors = {0.68, 0.7, 0.72, 0.69, 0.71, 0.7};
  const HierarchicalFit fit =
      fit_hierarchical(people_with_differences(factors, 12), kAtReference);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_LT(*fit.differences[0].standard_error, 0.8 * *fit.conditions[0].slope_standard_error);
}

TEST(HierarchicalFit, PeopleAllAlikeLeaveADifferenceWithoutAnInterval) {
  std::vector<ParticipantAnswers> all;
  for (const char* name : {"P1", "P2", "P3", "P4"}) {
    all.push_back(exact_answers(name, 0.5, 1.0, 20, "d"));
    all.push_back(exact_answers(name, 0.3, 1.0, 20, "e"));
  }
  const HierarchicalFit fit = fit_hierarchical(all, kAtReference);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_FALSE(fit.differences[0].standard_error);
  EXPECT_FALSE(fit.differences[0].ci95.low);
  EXPECT_FALSE(fit.differences[0].p_value);
  EXPECT_NE(fit.note.find("all alike"), std::string::npos) << fit.note;
}

TEST(HierarchicalFit, ACorrelationAtItsBoundIsSaid) {
  std::vector<ParticipantAnswers> answers;
  int number = 0;
  for (const double factor : {0.5, 0.7, 1.0, 1.45, 2.0}) {
    const std::string name = "P" + std::to_string(++number);
    for (const char* condition : {"d", "e"}) {
      answers.push_back(
          exact_answers(name, std::expm1(factor * std::log(1.5)), 1.0, 20, condition));
    }
  }
  const HierarchicalFit fit = fit_hierarchical(answers, kAtReference);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.correlation, 1.0, 1e-3);
  EXPECT_NE(fit.note.find("correlation"), std::string::npos) << fit.note;
}

TEST(HierarchicalFit, ALapseRateIsToldFromFlatCurves) {
  constexpr double kLapse = 0.02;
  std::vector<ParticipantAnswers> answers = differing_people(4000);
  for (ParticipantAnswers& one : answers) {
    for (AnswerCount& row : one.rows) {
      const auto n = static_cast<double>(row.num_trials);
      row.num_yes =
          std::llround(kLapse * n + (1.0 - 2.0 * kLapse) * static_cast<double>(row.num_yes));
    }
  }
  HierarchicalOptions options = kAtReference;
  const HierarchicalFit without = fit_hierarchical(answers, options);
  options.lapses = HierarchicalLapses::kCommon;
  const HierarchicalFit with = fit_hierarchical(answers, options);
  ASSERT_EQ(with.status, FitStatus::kOk) << with.reason;
  EXPECT_NEAR(*with.lapse_rate, kLapse, 1e-4);
  EXPECT_NEAR(*with.conditions[0].weber_fraction, 0.5, 0.01);
  EXPECT_GT(*without.conditions[0].weber_fraction, 0.53);
  EXPECT_FALSE(without.lapse_rate);
  EXPECT_NE(with.method.find("lapse rate"), std::string::npos) << with.method;
}

TEST(HierarchicalFit, AnswersWithoutLapsesGiveALapseRateOfNothingAndTheSameValues) {
  const std::vector<ParticipantAnswers> answers = differing_people(4000);
  HierarchicalOptions options = kAtReference;
  const HierarchicalFit without = fit_hierarchical(answers, options);
  options.lapses = HierarchicalLapses::kCommon;
  const HierarchicalFit with = fit_hierarchical(answers, options);
  ASSERT_EQ(with.status, FitStatus::kOk) << with.reason;
  EXPECT_EQ(*with.lapse_rate, 0.0) << "not what a search leaves of it";
  EXPECT_NEAR(*with.conditions[0].weber_fraction, *without.conditions[0].weber_fraction, 1e-4);
  EXPECT_NEAR(*with.conditions[0].weber_fraction_ci95.high,
              *without.conditions[0].weber_fraction_ci95.high, 1e-3);
}

TEST(HierarchicalFit, ManyLapsesAreSaid) {
  std::vector<ParticipantAnswers> answers = differing_people(4000);
  for (ParticipantAnswers& one : answers) {
    for (AnswerCount& row : one.rows) row.num_yes = 800 + row.num_yes * 6 / 10;
  }
  HierarchicalOptions options = kAtReference;
  options.lapses = HierarchicalLapses::kCommon;
  const HierarchicalFit fit = fit_hierarchical(answers, options);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.lapse_rate, 0.2, 1e-3);
  EXPECT_NE(fit.note.find("looks random"), std::string::npos) << fit.note;
}

/// Returns few answers to comparisons that are as hard as those of group D of
/// `viscosity_discrimination`.
std::vector<ParticipantAnswers> hard_answers(double widest) {
  std::vector<ParticipantAnswers> all;
  for (int person = 0; person < 6; ++person) {
    ParticipantAnswers one{"P" + std::to_string(person), "", 1.0, {}};
    for (const double share : {-1.0, -0.7, -0.3, 0.3, 0.7, 1.0}) {
      const double log_ratio = share * widest;
      const double p = core::standard_normal_cdf(log_ratio / std::log1p(0.7));
      one.rows.push_back({std::exp(log_ratio), std::llround(20.0 * p), 20});
    }
    all.push_back(std::move(one));
  }
  return all;
}

TEST(HierarchicalFit, WithoutLapsesFoundAnIntervalStillKnowsOfThoseThatMayBe) {
  HierarchicalOptions options = kAtReference;
  const HierarchicalFit none = fit_hierarchical(hard_answers(0.7), options);
  options.lapses = HierarchicalLapses::kCommon;
  const HierarchicalFit free = fit_hierarchical(hard_answers(0.7), options);
  ASSERT_EQ(free.status, FitStatus::kOk) << free.reason;
  ASSERT_EQ(*free.lapse_rate, 0.0);
  EXPECT_EQ(*free.lapse_rate_ci95.low, 0.0);
  EXPECT_GT(*free.lapse_rate_with_prior_ci95.high, 0.02);
  EXPECT_GT(*free.lapse_rate_ci95.high, *free.lapse_rate_with_prior_ci95.high);
  const Interval& fixed = none.conditions[0].weber_fraction_ci95;
  const Interval& wide = free.conditions[0].weber_fraction_ci95;
  EXPECT_LT(*wide.low, 0.93 * *fixed.low) << "lapses would make the curve steeper";
  EXPECT_NEAR(*wide.high, *fixed.high, 1e-4) << "and none flatter";
  // With a known rate at the end of the remaining range, the lower end of the interval is that
  // of the union.
  options.lapses = HierarchicalLapses::kKnown;
  options.lapse_rate = *free.lapse_rate_with_prior_ci95.high;
  const HierarchicalFit most = fit_hierarchical(hard_answers(0.7), options);
  EXPECT_NEAR(*most.conditions[0].weber_fraction_ci95.low, *wide.low, 1e-5);
  EXPECT_EQ(*most.lapse_rate, options.lapse_rate);
}

TEST(HierarchicalFit, ALapseRatesIntervalEndsWhereTheLikelihoodHasFallen) {
  std::vector<ParticipantAnswers> answers = differing_people(40);
  answers[0].rows[0].num_yes += 2;  // These are lapses at the easiest levels.
  answers[3].rows[5].num_yes -= 2;
  HierarchicalOptions options = kAtReference;
  options.lapses = HierarchicalLapses::kCommon;
  const HierarchicalFit free = fit_hierarchical(answers, options);
  ASSERT_EQ(free.status, FitStatus::kOk) << free.reason;
  options.lapses = HierarchicalLapses::kKnown;
  const auto log_likelihood = [&](double lapse_rate) {
    options.lapse_rate = lapse_rate;
    return *fit_hierarchical(answers, options).log_likelihood;
  };
  const double top = log_likelihood(*free.lapse_rate_without_prior);
  EXPECT_GT(top, log_likelihood(*free.lapse_rate));
  for (const double end : {*free.lapse_rate_ci95.low, *free.lapse_rate_ci95.high}) {
    EXPECT_NEAR(top - log_likelihood(end), end == 0.0 ? top - log_likelihood(0.0) : 1.920729,
                1e-4);
  }
}

TEST(HierarchicalFit, LevelsThatDoNotReachTheWeberFractionAreACaution) {
  // w = 0.7 is 0.53 in ln, so levels within 0.4 of the reference are all harder.
  for (const auto& [widest, is_hard] : {std::pair{0.4, true}, {0.7, false}}) {
    const HierarchicalFit fit =
        fit_hierarchical(hard_answers(widest), {.pse = HierarchicalPse::kReference});
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    const HierarchicalCondition& one = fit.conditions[0];
    ASSERT_EQ(one.cautions.size(), is_hard ? 1U : 0U) << widest;
    EXPECT_EQ(one.easy_ratio, is_hard ? 0.0 : 1.0 / 3.0);
    if (!is_hard) continue;
    const double w = *one.weber_fraction;
    char low[32], effect[32];
    std::snprintf(low, sizeof low, "levels up to %.3g", std::pow(1.0 + w, -2.5));
    std::snprintf(effect, sizeof effect, "instead of %.3g", w);
    EXPECT_NE(one.cautions[0].find(low), std::string::npos) << one.cautions[0];
    EXPECT_NE(one.cautions[0].find(effect), std::string::npos) << one.cautions[0];
  }
}

TEST(HierarchicalFit, AForcedChoiceHasItsGuesses) {
  // With two alternatives, half of the answers to what is not felt are right as well.
  std::vector<ParticipantAnswers> felt = differing_people(4000), right = felt;
  for (ParticipantAnswers& one : right) {
    for (AnswerCount& row : one.rows) row.num_yes = 2000 + row.num_yes / 2;
  }
  HierarchicalOptions options = kAtReference;
  const double w = *fit_hierarchical(felt, options).conditions[0].weber_fraction;
  options.guess_rate = 0.5;
  const HierarchicalFit fit = fit_hierarchical(right, options);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.conditions[0].weber_fraction, w, 2e-3);
  EXPECT_EQ(fit.guess_rate, 0.5);
  EXPECT_NE(fit.method.find("guess"), std::string::npos) << fit.method;
  options.guess_rate = 1.0;
  EXPECT_THROW((void)fit_hierarchical(right, options), core::Error);
}

/// Draws the answers of four people, eight at each level, one of a hundred of which is random.
std::vector<ParticipantAnswers> drawn_people(const std::string& condition, double w,
                                             std::uint64_t seed) {
  std::vector<ParticipantAnswers> all;
  for (std::int64_t person = 1; person <= 4; ++person) {
    core::RandomStream random(seed, condition, {person});
    ParticipantAnswers one{condition + std::to_string(person), condition, 1.0, {}};
    for (const double x : {0.5, 0.7, 0.85, 1.2, 1.4, 2.0}) {
      const double p = core::standard_normal_cdf(std::log(x) / std::log1p(w));
      std::int64_t num_yes = 0;
      for (int trial = 0; trial < 8; ++trial) {
        const bool lapses = random.with_probability(0.02);
        num_yes += random.with_probability(lapses ? 0.5 : p) ? 1 : 0;
      }
      one.rows.push_back({x, num_yes, 8});
    }
    all.push_back(std::move(one));
  }
  return all;
}

TEST(HierarchicalFit, OfTwoMaximaWithAndWithoutLapsesTheLargerIsFound) {
  // A search that starts at a lapse rate of 1 % ends at 0 here.
  const std::vector<ParticipantAnswers> all = drawn_people("b", 0.28, 251);
  HierarchicalOptions options = kAtReference;
  const HierarchicalFit without = fit_hierarchical(all, options);
  options.lapses = HierarchicalLapses::kCommon;
  const HierarchicalFit with = fit_hierarchical(all, options);
  ASSERT_EQ(with.status, FitStatus::kOk) << with.reason;
  EXPECT_GT(*with.lapse_rate, 0.01);
  // The prior is Beta(1, 20).
  const double log_prior = 19.0 * std::log1p(-2.0 * *with.lapse_rate);
  EXPECT_GT(*with.log_likelihood + log_prior, *without.log_likelihood + 1e-6);
}

TEST(HierarchicalFit, ConditionsOfOtherPeopleAreToldAlikeInEitherOrder) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<ParticipantAnswers> first = drawn_people("a", 0.17, seed);
    const std::vector<ParticipantAnswers> second = drawn_people("b", 0.28, seed);
    std::vector<ParticipantAnswers> both = first, turned = second;
    both.insert(both.end(), second.begin(), second.end());
    turned.insert(turned.end(), first.begin(), first.end());
    const HierarchicalOptions options{.pse = HierarchicalPse::kReference,
                                      .lapses = HierarchicalLapses::kCommon};
    const HierarchicalFit one = fit_hierarchical(both, options);
    const HierarchicalFit other = fit_hierarchical(turned, options);
    ASSERT_EQ(one.status, FitStatus::kOk) << one.reason;
    ASSERT_EQ(other.status, FitStatus::kOk) << other.reason;
    EXPECT_NEAR(*one.log_likelihood, *other.log_likelihood, 1e-5);
    EXPECT_NEAR(one.differences[0].estimate, -other.differences[0].estimate, 1e-4);
  }
}

TEST(HierarchicalFit, FewAnswersToHardComparisonsAreNotTakenForLapses) {
  // The answers are drawn without lapses, five at each level, none of which is easy. Without a
  // prior, the lapse rate would come out at some percent, and the Weber fraction a tenth too
  // small.
  constexpr int kGroups = 12;
  double sum_of_logs = 0.0;
  for (int group = 0; group < kGroups; ++group) {
    core::RandomStream random(7, "hard comparisons", {group});
    std::vector<ParticipantAnswers> all;
    for (int person = 0; person < 13; ++person) {
      ParticipantAnswers one{"P" + std::to_string(person), "", 1.0, {}};
      const double slope = std::exp(0.3 * random.normal()) / std::log1p(0.7);
      for (const double x : {0.59, 0.67, 0.89, 0.94, 1.19, 1.38, 1.72, 2.1}) {
        AnswerCount row{.intensity = x, .num_trials = 5};
        const double yes = core::standard_normal_cdf(slope * std::log(x));
        for (int trial = 0; trial < 5; ++trial) row.num_yes += random.with_probability(yes);
        one.rows.push_back(row);
      }
      all.push_back(std::move(one));
    }
    HierarchicalOptions options = kAtReference;
    const HierarchicalFit without = fit_hierarchical(all, options);
    options.lapses = HierarchicalLapses::kCommon;
    const HierarchicalFit with = fit_hierarchical(all, options);
    ASSERT_EQ(with.status, FitStatus::kOk) << with.reason;
    sum_of_logs +=
        std::log(*with.conditions[0].weber_fraction / *without.conditions[0].weber_fraction);
  }
  EXPECT_NEAR(sum_of_logs / kGroups, 0.0, 0.02);
}

TEST(HierarchicalFit, WhatHasNoValueSaysWhy) {
  const auto reason = [](const std::vector<ParticipantAnswers>& all) {
    const HierarchicalFit fit = fit_hierarchical(all, kAtReference);
    EXPECT_EQ(fit.status, FitStatus::kDegenerate);
    EXPECT_TRUE(fit.conditions.empty());
    return fit.reason;
  };
  EXPECT_NE(reason({}).find("fewer than two"), std::string::npos);
  EXPECT_NE(reason({exact_answers("P1", 0.5, 1.0, 10)}).find("fewer than two"),
            std::string::npos);
  std::vector<ParticipantAnswers> flat = {exact_answers("P1", 0.5, 1.0, 10),
                                          exact_answers("P2", 0.5, 1.0, 10)};
  for (ParticipantAnswers& one : flat) {
    for (AnswerCount& row : one.rows) row.num_yes = 5;
  }
  EXPECT_NE(reason(flat).find("flat"), std::string::npos);
  std::vector<ParticipantAnswers> separated = flat;
  for (ParticipantAnswers& one : separated) {
    for (AnswerCount& row : one.rows) row.num_yes = row.intensity > 1.0 ? 10 : 0;
  }
  EXPECT_NE(reason(separated).find("separated"), std::string::npos);
  std::vector<ParticipantAnswers> zero = flat;
  zero[0].rows.push_back({0.0, 1, 5});
  EXPECT_NE(reason(zero).find("intensity 0"), std::string::npos);
}

/// Returns people with a Weber fraction of 0.3 who favour the second interval by different
/// amounts.
std::vector<ParticipantAnswers> people_with_interval_biases(bool mirrored) {
  std::vector<ParticipantAnswers> all;
  for (const double bias : {-0.25, -0.1, 0.0, 0.05, 0.2, 0.4}) {
    ParticipantAnswers one{"P" + std::to_string(all.size() + 1), "", 1.0, {}};
    for (const double order : {kTestFirst, kTestSecond}) {
      for (const double x : {0.5, 0.7, 0.9, 1.1, 1.4, 2.0}) {
        const double z = (std::log(x) - 2.0 * order * bias) / std::log1p(0.3);
        const std::int64_t num_yes = std::llround(400.0 * core::standard_normal_cdf(z));
        if (mirrored && order == kTestFirst) {
          one.rows.push_back({1.0 / x, 400 - num_yes, 400});
        } else {
          one.rows.push_back({x, num_yes, 400, mirrored ? 0.0 : order});
        }
      }
    }
    all.push_back(std::move(one));
  }
  return all;
}

TEST(HierarchicalFit, AConditionWithoutOrdersKeepsItsOwnPseBesideOneWithOrders) {
  // Both conditions have the same Weber fraction. In the first, people favour an interval, and
  // in the second they differ in pse.
  std::vector<ParticipantAnswers> both;
  int number = 0;
  for (ParticipantAnswers one : people_with_interval_biases(false)) {
    const double pse = std::exp(0.15 * (number - 2.5));
    one.condition = "two_interval";
    both.push_back(one);
    both.push_back(exact_answers(one.participant, 0.3, pse, 800, "reminder"));
    ++number;
  }
  for (const HierarchicalPse pse : {HierarchicalPse::kPersonal, HierarchicalPse::kShared}) {
    const HierarchicalFit fit =
        fit_hierarchical(both, {.pse = pse, .lapses = HierarchicalLapses::kNone});
    ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
    EXPECT_NEAR(*fit.conditions[0].weber_fraction, 0.3, 3e-3);
    EXPECT_NEAR(*fit.conditions[1].weber_fraction, 0.3, 3e-3);
    EXPECT_NEAR(fit.differences[0].estimate, 0.0, 0.02);
    EXPECT_NEAR(fit.conditions[1].place_sd, 0.15 * std::sqrt(35.0 / 12.0), 0.01);
    EXPECT_NE(fit.method.find("or bias for an interval"), std::string::npos) << fit.method;
  }
}

TEST(HierarchicalFit, ABiasForAnIntervalIsAPersonsOwnAndLeavesTheWeberFractionAlone) {
  const HierarchicalFit fit =
      fit_hierarchical(people_with_interval_biases(false), kWithoutLapses);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_NEAR(*fit.conditions[0].weber_fraction, 0.3, 2e-3);
  EXPECT_NEAR(*fit.conditions[0].pse, 1.0, 2e-3);
  EXPECT_NE(fit.method.find("bias for an interval"), std::string::npos) << fit.method;
  // A fit that takes both orders for one finds a larger fraction.
  std::vector<ParticipantAnswers> pooled = people_with_interval_biases(false);
  for (ParticipantAnswers& one : pooled) {
    for (AnswerCount& row : one.rows) row.order = 0.0;
  }
  EXPECT_GT(*fit_hierarchical(pooled, kWithoutLapses).conditions[0].weber_fraction, 0.36);
}

/// A place of q o with o = +-1/2 is one of q / 2 in answers whose first order is mirrored.
TEST(HierarchicalFit, AnIntervalBiasIsThePseOfMirroredAnswers) {
  const HierarchicalFit found =
      fit_hierarchical(people_with_interval_biases(false), kAtReference);
  const HierarchicalFit other =
      fit_hierarchical(people_with_interval_biases(true), kWithoutLapses);
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  EXPECT_NEAR(*found.log_likelihood, *other.log_likelihood, 1e-6);
  EXPECT_NEAR(*found.conditions[0].weber_fraction, *other.conditions[0].weber_fraction, 1e-7);
  EXPECT_NEAR(*found.conditions[0].weber_fraction_ci95.low,
              *other.conditions[0].weber_fraction_ci95.low, 1e-5);
  EXPECT_NEAR(found.conditions[0].place_sd, 2.0 * other.conditions[0].place_sd, 1e-5);
}

TEST(HierarchicalFit, ReferencesThatDifferAndTooManyConditionsAreRefused) {
  std::vector<ParticipantAnswers> all = differing_people(10);
  all[1].reference = 2.0;
  EXPECT_THROW((void)fit_hierarchical(all, kWithoutLapses), core::Error);
  std::vector<ParticipantAnswers> three;
  for (const char* condition : {"a", "b", "c"}) {
    three.push_back(exact_answers("P1", 0.5, 1.0, 10, condition));
    three.push_back(exact_answers("P2", 0.4, 1.0, 10, condition));
  }
  EXPECT_THROW((void)fit_hierarchical(three, kWithoutLapses), core::Error);
  const HierarchicalFit shared = fit_hierarchical(three, {.pse = HierarchicalPse::kReference,
                                                          .slopes = HierarchicalSlopes::kShared,
                                                          .lapses = HierarchicalLapses::kNone});
  EXPECT_EQ(shared.status, FitStatus::kOk) << shared.reason;
  EXPECT_EQ(shared.conditions.size(), 3U);
  EXPECT_EQ(shared.differences.size(), 2U);
}

TEST(HierarchicalFit, APersonWhoComesTwiceInAConditionIsRefused) {
  std::vector<ParticipantAnswers> all = differing_people(10);
  all.push_back(all.front());
  EXPECT_THROW((void)fit_hierarchical(all, kWithoutLapses), core::Error);
}

TEST(HierarchicalFit, AnswersAllAlikeAreDegenerateAndNotCalledInverted) {
  for (const bool yes : {false, true}) {
    for (const HierarchicalPse pse :
         {HierarchicalPse::kReference, HierarchicalPse::kPersonal}) {
      std::vector<ParticipantAnswers> all;
      for (const char* name : {"P1", "P2", "P3"}) {
        all.push_back({name, "", 2.0, {{1, 0, 5}, {2, 0, 5}, {3, 0, 5}, {4, 0, 5}}});
        for (AnswerCount& row : all.back().rows) row.num_yes = yes ? 5 : 0;
      }
      const HierarchicalFit fit =
          fit_hierarchical(all, {.pse = pse, .lapses = HierarchicalLapses::kNone});
      EXPECT_EQ(fit.status, FitStatus::kDegenerate);
      EXPECT_TRUE(fit.reason.starts_with("all alike")) << fit.reason;
    }
  }
}

TEST(HierarchicalFit, AConditionOfOnePersonHasNoValueAndNoDifference) {
  std::vector<ParticipantAnswers> all;
  for (const auto& [name, w] : {std::pair{"P1", 0.4}, {"P2", 0.6}, {"P3", 0.5}}) {
    all.push_back(exact_answers(name, w, 1.0, 40, "d"));
  }
  all.push_back(exact_answers("P1", 0.3, 1.0, 40, "e"));
  const HierarchicalFit fit = fit_hierarchical(all, kAtReference);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_TRUE(fit.conditions[0].weber_fraction.has_value());
  EXPECT_FALSE(fit.conditions[1].weber_fraction.has_value());
  EXPECT_FALSE(fit.conditions[1].pse.has_value());
  EXPECT_TRUE(fit.differences.empty());
  EXPECT_NE(fit.note.find("e: no value"), std::string::npos) << fit.note;
}

const std::vector<AnswerCount> kStepWithLapses = {{0.5, 1, 20},   {0.7, 0, 20},  {0.85, 0, 20},
                                                  {1.15, 20, 20}, {1.3, 20, 20}, {1.5, 19, 20}};

/// The answers of five people are one step with a lapse at either end. Every steep curve fits
/// them, so the point at which the search stops is nobody's value.
TEST(HierarchicalFit, AStepWithLapsesHasNoValue) {
  std::vector<ParticipantAnswers> people;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    people.push_back({name, "", 1.0, kStepWithLapses});
  }
  const HierarchicalFit fit = fit_hierarchical(people, {});
  EXPECT_EQ(fit.status, FitStatus::kDegenerate);
  EXPECT_THAT(fit.reason, testing::HasSubstr("one step between two levels"));
  EXPECT_FALSE(fit.conditions.front().weber_fraction);
  EXPECT_FALSE(fit.conditions.front().pse);
}

TEST(HierarchicalFit, AStepInOneConditionLeavesTheOtherItsValue) {
  std::vector<ParticipantAnswers> people;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    people.push_back({name, "step", 1.0, kStepWithLapses});
    people.push_back(exact_answers(name, 0.3, 1.0, 40, "curve"));
  }
  const HierarchicalFit fit = fit_hierarchical(people, {});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_FALSE(fit.conditions[0].weber_fraction);
  EXPECT_FALSE(fit.conditions[0].weber_fraction_ci95.low);
  ASSERT_TRUE(fit.conditions[1].weber_fraction);
  EXPECT_NEAR(*fit.conditions[1].weber_fraction, 0.3, 0.03);
  EXPECT_TRUE(fit.differences.empty());
  EXPECT_THAT(fit.note, testing::HasSubstr("step: no value"));
  for (const HierarchicalPersonEstimate& one : fit.participants) {
    EXPECT_EQ(one.weber_fraction.has_value(), one.condition == "curve") << one.condition;
  }
}

/// The answers have another shape than the curve: no lapse rate makes them rise, fall and rise.
TEST(HierarchicalFit, AnswersOfAnotherShapeHaveACaution) {
  const std::vector<AnswerCount> wrong = {{0.5, 2, 40},   {0.7, 16, 40}, {0.85, 8, 40},
                                          {1.15, 32, 40}, {1.3, 24, 40}, {1.5, 38, 40}};
  std::vector<ParticipantAnswers> odd, right;
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    odd.push_back({name, "", 1.0, wrong});
    right.push_back(exact_answers(name, 0.3, 1.0, 40));
  }
  const HierarchicalFit fit = fit_hierarchical(odd, {});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_THAT(fit.conditions.front().cautions,
              testing::Contains(testing::HasSubstr("farther from people's curves")));
  EXPECT_TRUE(fit.conditions.front().is_rejected_by_fit);
  EXPECT_TRUE(fit_hierarchical(right, {}).conditions.front().cautions.empty());
  EXPECT_FALSE(fit_hierarchical(right, {}).conditions.front().is_rejected_by_fit);
}

}  // namespace hierarchical_fit_test
}  // namespace jnd::analysis
