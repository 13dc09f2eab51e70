#include "analysis/results/predictive_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace predictive_comparison_test {

using Kind = PublishedStatistic::Kind;
using Summary = PublishedStatistic::Summary;

/// Returns people with standard normal numbers "x" and "y", which share most of their variance.
PredictivePeople people(int num_groups = 10, int size = 104) {
  PredictivePeople all{.seed = 1};
  core::RandomStream random(7, "people");
  for (int group = 0; group < num_groups; ++group) {
    auto& members = all.groups.emplace_back();
    for (int i = 0; i < size; ++i) {
      PersonOutcome& one = members.emplace_back();
      one.cells = i % 4 == 0 ? "order=a" : "order=b";
      const double common = random.normal();
      one.numbers["x"] = 0.95 * common + std::sqrt(1.0 - 0.95 * 0.95) * random.normal();
      one.numbers["y"] = 0.95 * common + std::sqrt(1.0 - 0.95 * 0.95) * random.normal();
      one.numbers["is_a"] = i % 4 == 0 ? 1.0 : 0.0;
    }
  }
  return all;
}

PublishedValue mean_of(const std::string& name, double value) {
  return {.value = value,
          .compute = PublishedStatistic{.kind = Kind::kNumbers, .names = {name}}};
}

const double kStandardError = 1.0 / std::sqrt(13.0);

TEST(PredictiveStudies, TheTailOfAMeanIsThatOfTheNormalDistribution) {
  const PredictivePeople all = people();
  const PredictiveStudies studies(all, 13, 1000);
  EXPECT_EQ(studies.num_studies(), 1000);
  const auto above = studies.tail_of(mean_of("x", 1.6448536 * kStandardError));
  ASSERT_TRUE(above);
  EXPECT_FALSE(above->is_below);
  // One study in twenty lies above. A thousand people determine the mean to a tenth of a
  // study's standard error.
  EXPECT_NEAR(above->tail, 0.05, 4.0 * above->standard_error + 0.01);
  EXPECT_GT(above->standard_error, 0.002);
  EXPECT_LT(above->standard_error, 0.03);
  EXPECT_DOUBLE_EQ(above->p_value, 2.0 * above->tail);
  EXPECT_NEAR(above->median, 0.0, 0.12);
  EXPECT_NEAR(above->high - above->low, 2.0 * 1.96 * kStandardError, 0.12);
  const auto below = studies.tail_of(mean_of("x", -3.0));
  EXPECT_TRUE(below->is_below);
  EXPECT_EQ(below->tail, 0.0);
}

TEST(PredictiveStudies, FewerParticipantsMakeAWiderDistribution) {
  const PredictivePeople all = people();
  const PredictiveStudies studies(all, 13, 1000);
  PublishedValue value = mean_of("x", 0.0);
  const auto of_all = studies.tail_of(value);
  value.n = 4;
  const auto of_four = studies.tail_of(value);
  EXPECT_NEAR((of_four->high - of_four->low) / (of_all->high - of_all->low),
              std::sqrt(13.0 / 4.0), 0.2);
}

TEST(PredictiveStudies, CellsAreFilledEvenlyHoweverManyOfEachThereAre) {
  const PredictivePeople all = people();
  const auto share = PredictiveStudies(all, 13, 200).tail_of(mean_of("is_a", 0.5));
  ASSERT_TRUE(share);
  for (const double value : share->values) {
    EXPECT_TRUE(std::abs(value - 6.0 / 13.0) < 1e-12 || std::abs(value - 7.0 / 13.0) < 1e-12)
        << value;
  }
}

TEST(PredictiveStudies, NobodyIsTwiceInAStudy) {
  const PredictivePeople all = people(2, 13);
  const auto mean = PredictiveStudies(all, 13, 50).tail_of(mean_of("x", 0.0));
  ASSERT_TRUE(mean);
  // Every study takes all people of a group, so there are only two means, whatever the order.
  EXPECT_NEAR(mean->values[0], mean->values[24], 1e-12);
  EXPECT_NEAR(mean->values[25], mean->values[49], 1e-12);
}

TEST(PredictiveStudies, ValuesAreAsCoarseAsThePublishedOne) {
  const PredictivePeople all = people();
  const PredictiveStudies studies(all, 13, 1000);
  PublishedValue value = mean_of("x", 0.6);
  const double exact = studies.tail_of(value)->tail;
  value.num_decimals = 1;  // A value of 0.55 is printed as 0.6, too.
  EXPECT_GT(studies.tail_of(value)->tail, exact);
  EXPECT_NEAR(studies.tail_of(value)->tail, studies.tail_of(mean_of("x", 0.55))->tail, 1e-12);
}

TEST(PredictiveStudies, TogetherIsFarOutWhatIsNotSoOneByOne) {
  const PredictivePeople all = people();
  const PredictiveStudies studies(all, 13, 1000);
  const PublishedValue x = mean_of("x", 1.3 * kStandardError);
  const PublishedValue y_alike = mean_of("y", 1.3 * kStandardError);
  const PublishedValue y_other = mean_of("y", -1.3 * kStandardError);
  EXPECT_GT(studies.tail_of(x)->tail, 0.05);
  EXPECT_GT(studies.tail_of(y_other)->tail, 0.05);
  const auto alike = studies.joint_tail({x, y_alike});
  const auto contradicting = studies.joint_tail({x, y_other});
  ASSERT_TRUE(alike && contradicting);
  EXPECT_EQ(alike->num_statistics, 2);
  EXPECT_GT(alike->p_value, 0.1);
  EXPECT_LT(contradicting->p_value, 0.005);
}

/// The published study is drawn like the simulated ones. Then its p value lies below any share
/// with a probability of that share.
TEST(PredictiveStudies, TheJointTailOfAStudyLikeTheSimulatedOnesIsEvenlySpread) {
  const PredictivePeople all = people();
  const PredictiveStudies studies(all, 13, 400);
  core::RandomStream random(11, "published studies");
  int num_below_fifth = 0;
  constexpr int kStudies = 200;
  for (int study = 0; study < kStudies; ++study) {
    double x = 0.0, y = 0.0;
    for (int i = 0; i < 13; ++i) {
      const double common = random.normal();
      x += (0.95 * common + std::sqrt(1.0 - 0.95 * 0.95) * random.normal()) / 13.0;
      y += (0.95 * common + std::sqrt(1.0 - 0.95 * 0.95) * random.normal()) / 13.0;
    }
    num_below_fifth +=
        studies.joint_tail({mean_of("x", x), mean_of("y", y)})->p_value <= 0.2 ? 1 : 0;
  }
  EXPECT_NEAR(num_below_fifth, 0.2 * kStudies, 3.0 * std::sqrt(0.2 * 0.8 * kStudies));
}

TEST(PredictiveStudies, WhatFollowsFromOthersAndWhatHasNoStatisticIsNotCountedTwice) {
  const PredictivePeople all = people();
  const PredictiveStudies studies(all, 13, 200);
  PublishedValue follows = mean_of("x", 0.1);
  follows.follows_from_others = true;
  EXPECT_EQ(studies.joint_tail({mean_of("x", 0.1), follows, {.value = 3.0}})->num_statistics,
            1);
  EXPECT_FALSE(studies.joint_tail({follows}));
  EXPECT_FALSE(studies.tail_of({.value = 3.0}));
  EXPECT_FALSE(studies.tail_of(mean_of("unknown", 1.0)));
}

TEST(PredictiveStudies, AGroupTooSmallForAStudyIsAnError) {
  EXPECT_THROW(PredictiveStudies(people(2, 12), 13, 10), core::Error);
  EXPECT_THROW(PredictiveStudies(people(2, 12), 0, 10), core::Error);
}

}  // namespace predictive_comparison_test
}  // namespace jnd::analysis
