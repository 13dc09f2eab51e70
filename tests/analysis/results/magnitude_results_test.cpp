#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/data/magnitude_means.h"
#include "analysis/found_results.h"
#include "analysis/results/magnitude_fits.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace magnitude_results_test {

const ResultsOptions kQuick = {.num_resamples = 100, .seed = 1};
const BlockDesign kEstimation = {.block = "estimation",
                                 .procedure = "magnitude_estimation",
                                 .quantity = "scale",
                                 .num_trials = 9,
                                 .measures = Measure::kMagnitude};
const BlockDesign kProduction = {.block = "production",
                                 .procedure = "magnitude_production",
                                 .quantity = "scale",
                                 .num_trials = 9,
                                 .measures = Measure::kProducedMagnitude};

core::TrialRow estimated(double intensity, double percent, std::int64_t repetition = 1) {
  return {.block = "estimation",
          .repetition = repetition,
          .intensity = intensity,
          .response = percent};
}

core::TrialRow produced(double target_percent, double set) {
  return {.block = "production",
          .repetition = 1,
          .intensity = set,
          .target_percent = target_percent,
          .response = set};
}

bool says(const ResultsSection& section, const std::string& participant,
          const std::string& words) {
  return std::ranges::any_of(section.excluded, [&](const ExcludedParticipant& one) {
    return one.participant == participant && one.reason.find(words) != std::string::npos;
  });
}

/// Returns two people who answer 1/2 sqrt(I) and 2 sqrt(I), so their units differ by a factor
/// of 4.
StudyData two_units() {
  StudyData data;
  for (const auto& [name, k] : {std::pair{"P01", 0.5}, {"P02", 2.0}}) {
    ParticipantData person{.participant = name};
    for (const double intensity : {0.0, 1.0, 4.0, 9.0}) {
      person.trials.push_back(estimated(intensity, 100.0 * k * std::sqrt(intensity)));
    }
    data.participants.push_back(person);
  }
  return data;
}

TEST(LogAnswers, AZeroCountsAsHalfTheSmallestAnswerOfThePersonOrNotAtAll) {
  const MagnitudeAnswers answers = {{0.0, {0.0, 0.0}}, {1.0, {0.0, 0.4}}, {2.0, {0.8}}};
  const LogAnswers half = log_answers(answers, ZeroRule::kHalfSmallest);
  EXPECT_EQ(half.num_zeros, 1) << "free space felt as nothing is no zero to mend";
  EXPECT_EQ(half.logs.size(), 2U);
  EXPECT_DOUBLE_EQ(half.logs.at(1.0)[0], std::log(0.2));
  EXPECT_DOUBLE_EQ(half.logs.at(1.0)[1], std::log(0.4));
  const LogAnswers out = log_answers(answers, ZeroRule::kLeaveOut);
  EXPECT_EQ(out.num_zeros, 1);
  EXPECT_EQ(out.logs.at(1.0).size(), 1U);
  // If no answer is above 0, there is no logarithm, and no number is invented.
  const LogAnswers none = log_answers({{1.0, {0.0}}, {2.0, {0.0}}}, ZeroRule::kHalfSmallest);
  EXPECT_TRUE(none.logs.empty());
  EXPECT_EQ(none.num_zeros, 2);
}

TEST(MagnitudeResults, GeometricMeansAndEqualisedModuliForgetWhoCountsInLargeNumbers) {
  const ResultsSection section = estimation_results(two_units(), kEstimation, kQuick);
  EXPECT_NEAR(value_of(section, "estimation.mean_at_4"), 2.5, 1e-12);
  EXPECT_NEAR(value_of(section, "estimation.geometric_mean_at_4"), 2.0, 1e-12);
  EXPECT_EQ(find_estimate(section, "estimation.geometric_mean_at_0"), nullptr);
  EXPECT_NEAR(value_of(section, "estimation.k"), 1.25, 1e-6);
  EXPECT_NEAR(value_of(section, "estimation.geometric.k"), 1.0, 1e-9);
  EXPECT_NEAR(value_of(section, "estimation.geometric.a"), 0.5, 1e-9);
  EXPECT_NEAR(value_of(section, "estimation.equalised.k"), 1.0, 1e-6);
  EXPECT_NEAR(value_of(section, "estimation.equalised.a"), 0.5, 1e-6);
  // The values are ln 4 apart. The standard deviation of two values is their difference over
  // sqrt 2.
  EXPECT_NEAR(value_of(section, "estimation.modulus_sd_ln"), std::log(4.0) / std::sqrt(2.0),
              1e-12);
  EXPECT_EQ(value_of(section, "estimation.num_zeros"), 0.0);
  EXPECT_EQ(find_estimate(section, "estimation.geometric_without_zeros.a"), nullptr);
}

TEST(MagnitudeResults, ZerosAreCountedAndBothRulesShown) {
  StudyData data = two_units();
  data.participants[0].trials.push_back(estimated(4.0, 0.0, 2));
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  EXPECT_EQ(value_of(section, "estimation.num_zeros"), 1.0);
  // The answers are 1 and, for the 0, half of the smallest answer, 0.25. So the geometric mean
  // is 1/2, and that of the other person 4.
  EXPECT_NEAR(value_of(section, "estimation.geometric_mean_at_4"), std::sqrt(0.5 * 4.0), 1e-12);
  EXPECT_NE(find_estimate(section, "estimation.geometric.k")
                ->meaning.find("half the person's smallest"),
            std::string::npos);
  EXPECT_NEAR(value_of(section, "estimation.geometric_without_zeros.k"), 1.0, 1e-9);
}

TEST(MagnitudeResults, APersonWithoutALevelStillCountsInTheOthers) {
  StudyData data = two_units();
  data.participants[1].trials.pop_back();
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  EXPECT_EQ(find_estimate(section, "estimation.mean_at_9")->n, 1);
  EXPECT_EQ(find_estimate(section, "estimation.mean_at_4")->n, 2);
  // The moduli are computed over the levels that both people have, so nothing changes.
  EXPECT_NEAR(value_of(section, "estimation.equalised.k"), 1.0, 1e-6);
}

TEST(MagnitudeResults, SomebodyWhoFeltNothingSpoilsOnlyTheirOwnLine) {
  StudyData data = two_units();
  ParticipantData numb{.participant = "P03"};
  for (const double intensity : {1.0, 4.0, 9.0}) numb.trials.push_back(estimated(intensity, 0));
  data.participants.push_back(numb);
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  EXPECT_FALSE(own_of(section, "P03", "estimation.a").value);
  EXPECT_FALSE(own_of(section, "P03", "estimation.a").reason.empty());
  EXPECT_TRUE(own_of(section, "P01", "estimation.a").value);
  EXPECT_TRUE(find_estimate(section, "estimation.k")->value);
  EXPECT_TRUE(find_estimate(section, "estimation.geometric.k")->value);
  EXPECT_TRUE(says(section, "everyone", "no stimulus that all participants answered above 0"));
  EXPECT_EQ(find_estimate(section, "estimation.individual_a_mean")->n, 2);
}

TEST(MagnitudeResults, OnlyThoseCountWhoAreInAGeometricPowerLaw) {
  StudyData data = two_units();
  ParticipantData numb{.participant = "P03"};
  for (const double intensity : {1.0, 4.0, 9.0}) numb.trials.push_back(estimated(intensity, 0));
  data.participants.push_back(numb);
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  for (const char* law : {"estimation.geometric", "estimation.geometric_without_zeros"}) {
    EXPECT_EQ(find_estimate(section, std::string(law) + ".k")->n, 2) << law;
    EXPECT_EQ(find_estimate(section, std::string(law) + ".a")->n, 2) << law;
  }
  EXPECT_EQ(find_estimate(section, "estimation.k")->n, 3)
      << "a mean of 0 pulls the group's down";
  EXPECT_TRUE(says(section, "P03", "every answer is 0, which has no logarithm"));
  EXPECT_NE(
      find_estimate(section, "estimation.num_zeros")->meaning.find("nothing of who has none"),
      std::string::npos);
  const ResultsSection sound = estimation_results(two_units(), kEstimation, kQuick);
  EXPECT_EQ(
      find_estimate(sound, "estimation.num_zeros")->meaning.find("nothing of who has none"),
      std::string::npos);
}

TEST(MagnitudeResults, WhoAnsweredAtIntensityZeroAloneIsInNoPowerLaw) {
  StudyData data = two_units();
  data.participants.push_back({.participant = "P03", .trials = {estimated(0.0, 0.0)}});
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  EXPECT_EQ(find_estimate(section, "estimation.k")->n, 2);
  EXPECT_EQ(find_estimate(section, "estimation.geometric.k")->n, 2);
  EXPECT_EQ(find_estimate(section, "estimation.mean_at_0")->n, 3);
  EXPECT_TRUE(says(section, "P03", "no answer at an intensity above 0"));
}

TEST(MagnitudeResults, AnOwnLawThroughEveryMeanHasNoIntervalAndSaysWhy) {
  StudyData data = two_units();
  ParticipantData constant{.participant = "P03"};
  for (const double intensity : {0.0, 1.0, 2.0, 4.0, 9.0}) {
    constant.trials.push_back(estimated(intensity, 100.0));
  }
  data.participants.push_back(constant);
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  for (const char* name :
       {"estimation.geometric.k", "estimation.geometric.a", "estimation.k"}) {
    const ParticipantEstimate& one = own_of(section, "P03", name);
    EXPECT_TRUE(one.value.has_value()) << name;
    EXPECT_FALSE(one.ci95.low || one.ci95.high) << name;
    ASSERT_EQ(one.cautions.size(), 1U) << name;
    EXPECT_EQ(one.cautions[0], "no interval: the power law passes through every row");
  }
}

TEST(MagnitudeResults, PeopleWhoAllAnswerAlikeHaveNoIntervalOfTheGroup) {
  StudyData data;
  for (const char* name : {"P01", "P02", "P03", "P04", "P05", "P06"}) {
    ParticipantData person{.participant = name};
    for (const double intensity : {1.0, 2.0, 4.0, 9.0}) {
      person.trials.push_back(estimated(intensity, 100.0));
    }
    data.participants.push_back(person);
  }
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  const Estimate& k = *find_estimate(section, "estimation.k");
  EXPECT_NEAR(k.value.value(), 1.0, 1e-9);
  EXPECT_FALSE(k.ci95.low || k.ci95.high);
  ASSERT_EQ(k.cautions.size(), 1U);
  EXPECT_NE(k.cautions[0].find("no interval"), std::string::npos);
}

TEST(MagnitudeResults, AGroupWithoutAPowerLawSaysWhyOnce) {
  StudyData data;
  data.participants.push_back(
      {.participant = "P01", .trials = {estimated(2.0, 100.0), estimated(2.0, 120.0, 2)}});
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  EXPECT_FALSE(find_estimate(section, "estimation.k")->value);
  EXPECT_EQ(std::ranges::count(section.excluded, "everyone", &ExcludedParticipant::participant),
            1);
  EXPECT_TRUE(says(section, "everyone", "estimation: no power law"));
  EXPECT_NEAR(value_of(section, "estimation.mean_at_2"), 1.1, 1e-12);
}

TEST(MagnitudeResults, TrialCorrelationsOfEachParticipantHaveFishersInterval) {
  StudyData data;
  ParticipantData person{.participant = "P01"};
  const std::vector<double> first = {10, 40, 50, 90, 70}, second = {20, 30, 80, 70, 90};
  for (std::size_t i = 0; i < first.size(); ++i) {
    person.trials.push_back(estimated(1.0 + static_cast<double>(i), first[i], 1));
    person.trials.push_back(estimated(1.0 + static_cast<double>(i), second[i], 2));
  }
  data.participants.push_back(person);
  const ResultsSection section = estimation_results(data, kEstimation, kQuick);
  const Comparison expected = pearson_correlation(first, second);
  const ParticipantEstimate& r = own_of(section, "P01", "trial_correlation.t1_t2");
  EXPECT_EQ(r.value, expected.estimate);
  EXPECT_EQ(r.ci95.low, expected.ci95.low);
}

TEST(MagnitudeResults, TheRegressionOfIOnSTurnsTheOtherWayRound) {
  // Without spread both regressions agree: I = 2 S^2, S = (I / 2)^(1/2).
  StudyData data;
  for (const char* name : {"P01", "P02"}) {
    ParticipantData person{.participant = name};
    for (const double target : {0.5, 1.0, 2.0}) {
      person.trials.push_back(produced(100.0 * target, 2.0 * target * target));
    }
    data.participants.push_back(person);
  }
  const ResultsSection exact = production_results(data, kProduction, kQuick);
  for (const char* law :
       {"production", "production.geometric", "production.intensity_on_magnitude"}) {
    EXPECT_NEAR(value_of(exact, std::string(law) + ".a"), 0.5, 1e-6) << law;
    EXPECT_NEAR(value_of(exact, std::string(law) + ".k"), std::sqrt(0.5), 1e-6) << law;
  }
  // With spread, S on I is the flatter and I on S the steeper regression. They differ by r
  // squared.
  data.participants[0].trials[1].response = 5.0;
  const ResultsSection section = production_results(data, kProduction, kQuick);
  EXPECT_GT(value_of(section, "production.intensity_on_magnitude.a"),
            value_of(section, "production.geometric.a"));
}

TEST(FitIntensityOnMagnitude, RefusesAnInvertedProductionAndLeavesAnEndOpenWhereItMust) {
  const PowerFit inverted =
      fit_intensity_on_magnitude({{0.5, std::log(4.0)}, {1.0, 0.0}, {2.0, std::log(0.5)}});
  EXPECT_EQ(inverted.status, FitStatus::kDegenerate);
  EXPECT_FALSE(inverted.a.has_value());
  EXPECT_FALSE(inverted.reason.empty());
  const PowerFit noisy =
      fit_intensity_on_magnitude({{0.5, 0.0}, {1.0, 2.0}, {2.0, 0.2}, {2.0, 0.9}});
  ASSERT_EQ(noisy.status, FitStatus::kOk) << noisy.reason;
  EXPECT_TRUE(noisy.a_ci95.low.has_value());
  EXPECT_LT(*noisy.a_ci95.low, *noisy.a);
  EXPECT_FALSE(noisy.a_ci95.high.has_value()) << "a slope of 0 would be an infinite exponent";
}

TEST(MagnitudeResults, ProductionRatiosAreThereForEachParticipantOrTheReason) {
  StudyData data;
  data.participants.push_back(
      {.participant = "P01", .trials = {produced(50, 1.0), produced(100, 3.0)}});
  data.participants.push_back(
      {.participant = "P02", .trials = {produced(50, 0.0), produced(100, 3.0)}});
  data.participants.push_back({.participant = "P03", .trials = {produced(100, 3.0)}});
  const ResultsSection section = production_results(data, kProduction, kQuick);
  EXPECT_NEAR(own_of(section, "P01", "production_ratio_100_50").value.value(), 3.0, 1e-12);
  EXPECT_EQ(own_of(section, "P02", "production_ratio_100_50").reason,
            "0 was set for the lower target");
  EXPECT_EQ(own_of(section, "P03", "production_ratio_100_50").reason,
            "one of the targets has no answer");
  EXPECT_EQ(find_estimate(section, "production_ratio_100_50")->n, 1);
}

/// Returns people with sqrt(I) in estimation, and with 0.25 I^2 in production, for targets at 1
/// and 4.
StudyData both_parts() {
  StudyData data;
  for (const char* name : {"P01", "P02"}) {
    ParticipantData person{.participant = name};
    for (const double intensity : {0.0, 1.0, 4.0, 9.0}) {
      person.trials.push_back(estimated(intensity, 100.0 * std::sqrt(intensity)));
    }
    person.trials.push_back(produced(100.0, 2.0));
    person.trials.push_back(produced(400.0, 4.0));
    data.participants.push_back(person);
  }
  return data;
}

TEST(CombinedResults, TheGeometricMeanLineLiesHalfWayInLogarithms) {
  const ResultsSection section =
      combined_results(both_parts(), kEstimation, kProduction, kQuick);
  EXPECT_NEAR(value_of(section, "combined.geometric_mean.k"), 0.5, 1e-6);
  EXPECT_NEAR(value_of(section, "combined.geometric_mean.a"), 1.25, 1e-6);
}

TEST(CombinedResults, SayWhereACurveIsExtrapolated) {
  const ResultsSection section =
      combined_results(both_parts(), kEstimation, kProduction, kQuick);
  EXPECT_NEAR(value_of(section, "combined.shared_range_low"), 2.0, 1e-12);
  EXPECT_NEAR(value_of(section, "combined.shared_range_high"), 4.0, 1e-12);
  EXPECT_EQ(value_of(section, "combined.num_extrapolated"), 2.0) << "1 and 9, not free space";
  // Only 4 lies within the range. No law goes through one intensity, and the results say so.
  EXPECT_FALSE(find_estimate(section, "combined.within_shared_range.k")->value);
  EXPECT_TRUE(says(section, "everyone", "combined.within_shared_range: no power law"));
  EXPECT_TRUE(find_estimate(section, "combined.k")->value);
}

TEST(CombinedResults, AProductionOfNothingReachesNoIntensity) {
  StudyData data = both_parts();
  for (ParticipantData& person : data.participants)
    person.trials.push_back(produced(25.0, 0.0));
  const ResultsSection section = combined_results(data, kEstimation, kProduction, kQuick);
  EXPECT_NEAR(value_of(section, "combined.shared_range_low"), 2.0, 1e-12);
}

TEST(CombinedResults, NoSharedIntensityIsSaid) {
  StudyData data = both_parts();
  for (ParticipantData& person : data.participants) {
    for (core::TrialRow& trial : person.trials) {
      if (trial.target_percent) trial.response = *trial.response * 10.0;
    }
  }
  const ResultsSection section = combined_results(data, kEstimation, kProduction, kQuick);
  EXPECT_FALSE(find_estimate(section, "combined.shared_range_low")->value);
  EXPECT_TRUE(says(section, "everyone", "no intensity that both"));
  EXPECT_TRUE(find_estimate(section, "combined.k")->value) << "the curve itself is still there";
}

TEST(CombinedResults, WhoLacksEitherPartIsNamedAndOnlyTheOthersCount) {
  StudyData data = both_parts();
  data.participants.push_back({.participant = "P03", .trials = {estimated(1.0, 500.0)}});
  data.participants.push_back({.participant = "P04", .trials = {produced(100.0, 9.0)}});
  const ResultsSection section = combined_results(data, kEstimation, kProduction, kQuick);
  EXPECT_TRUE(says(section, "P03", "no answers in production"));
  EXPECT_TRUE(says(section, "P04", "no answers in estimation"));
  EXPECT_EQ(find_estimate(section, "combined.k")->n, 2);
  EXPECT_NEAR(value_of(section, "combined.geometric_mean.k"), 0.5, 1e-6);
}

TEST(CombinedResults, AProductionWithoutALawIsNamedAsTheReason) {
  StudyData data = both_parts();
  for (ParticipantData& person : data.participants) person.trials.pop_back();
  const ResultsSection section = combined_results(data, kEstimation, kProduction, kQuick);
  EXPECT_FALSE(find_estimate(section, "combined.k")->value);
  EXPECT_TRUE(says(section, "everyone", "the production has none"));
  EXPECT_EQ(section.comparisons[0].comparison.status, FitStatus::kDegenerate);
}

TEST(CombinedResults, ExponentsAreComparedWithTheProductionAsIOnS) {
  StudyData data = both_parts();
  // The settings scatter, so S on I is flatter than I on S.
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<core::TrialRow>& trials = data.participants[i].trials;
    const double more = 1.0 + static_cast<double>(i);
    trials.push_back(produced(50.0, more));
    trials.push_back(produced(50.0, 2.5));
    trials.push_back(produced(100.0, 3.0));
  }
  const ResultsSection section = combined_results(data, kEstimation, kProduction, kQuick);
  const ResultsSection production = production_results(data, kProduction, kQuick);
  const auto mean_of = [&](const std::string& name) {
    return 0.5 *
           (*own_of(production, "P01", name).value + *own_of(production, "P02", name).value);
  };
  const auto estimate_of = [&](const std::string& words) {
    for (const NamedComparison& one : section.comparisons) {
      if (one.name.find(words) != std::string::npos) return *one.comparison.estimate;
    }
    throw core::Error("no comparison " + words);
  };
  EXPECT_NEAR(estimate_of("production as I on S (primary): paired t"),
              0.5 - mean_of("production.intensity_on_magnitude.a"), 1e-9);
  EXPECT_NEAR(estimate_of("production as S on I (secondary): paired t"),
              0.5 - mean_of("production.a"), 1e-6);
  EXPECT_NE(section.comparisons[0].name.find("primary"), std::string::npos);
  EXPECT_GT(mean_of("production.intensity_on_magnitude.a"), 0.0);
}

TEST(MagnitudeResults, WhatIsTheSameByConstructionAndWhatAPointAtZeroAddsIsSaid) {
  const ResultsSection section = estimation_results(two_units(), kEstimation, kQuick);
  EXPECT_NEAR(value_of(section, "estimation.data_points.a"), value_of(section, "estimation.a"),
              1e-6);
  EXPECT_NE(find_estimate(section, "estimation.data_points.a")->meaning.find("by construction"),
            std::string::npos);
  EXPECT_NE(
      find_estimate(section, "estimation.r_squared")->meaning.find("1 at intensity 0 left out"),
      std::string::npos);
  EXPECT_NE(find_estimate(section, "estimation.k")->meaning.find("1 at intensity 0 left out"),
            std::string::npos);
  EXPECT_NE(find_estimate(section, "estimation.data_points.k")
                ->meaning.find("2 at intensity 0 left out"),
            std::string::npos);
}

}  // namespace magnitude_results_test
}  // namespace jnd::analysis
