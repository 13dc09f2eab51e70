#include "analysis/fits/chance_level.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/psychometric_function.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace chance_level_test {

/// Draws answers to the levels, each with the probability of the curve.
template <typename Curve>
std::vector<AnswerCount> drawn(const std::vector<double>& intensities, std::int64_t num_trials,
                               core::RandomStream& random, const Curve& curve) {
  std::vector<AnswerCount> rows;
  for (const double intensity : intensities) {
    AnswerCount row = {intensity, 0, num_trials};
    for (std::int64_t trial = 0; trial < num_trials; ++trial) {
      row.num_yes += random.with_probability(curve(intensity)) ? 1 : 0;
    }
    rows.push_back(row);
  }
  return rows;
}

/// Returns the share of drawn sets in which any chance level is suspected.
template <typename Curve>
double share_suspected(const std::vector<double>& intensities, std::int64_t num_trials,
                       const Curve& curve) {
  constexpr int kSets = 400;
  core::RandomStream random(2, "chance level test");
  int num = 0;
  for (int set = 0; set < kSets; ++set) {
    num += suspected_chance(drawn(intensities, num_trials, random, curve)) ? 1 : 0;
  }
  return static_cast<double>(num) / kSets;
}

const std::vector<double> kThin = {1.093, 1.237, 1.646, 1.7495, 2.203, 2.553, 3.185, 3.883};
const std::vector<double> kForced = {0.37, 0.55, 0.82, 1.22, 1.82, 2.72};

auto yes_no(double reference, double weber_fraction) {
  return [=](double intensity) {
    return core::PsychometricFunction{.pse = reference, .weber_fraction = weber_fraction}
        .probability(intensity);
  };
}

auto forced(double chance, double lapse = 0.0) {
  return [=](double intensity) {
    return chance + (1.0 - chance - lapse) * yes_no(1.0, 0.4)(intensity);
  };
}

TEST(ChanceLevel, APublishedForcedChoiceIsSuspectedThoughALevelLiesBelowChance) {
  // The demonstration data of psignifit (Wichmann and Hill 2001) have two alternatives, and 44
  // of 90 lie below one half.
  const std::vector<AnswerCount> demo = {
      {0.001, 45, 90},  {0.0015, 50, 90}, {0.002, 44, 90},  {0.0025, 44, 90}, {0.003, 52, 90},
      {0.0035, 53, 90}, {0.004, 62, 90},  {0.0045, 64, 90}, {0.005, 76, 90},  {0.006, 79, 90},
      {0.007, 88, 90},  {0.008, 90, 90},  {0.01, 90, 90}};
  EXPECT_EQ(suspected_chance(demo), 1.0 / 2.0);
}

TEST(ChanceLevel, AStaircaseOfForcedChoicesIsSuspected) {
  // A staircase of two down, one up has hardly a level at which nothing is felt, and one wrong
  // answer there.
  const std::vector<AnswerCount> rows = {{0.6, 1, 3},   {0.8, 7, 12},  {1.0, 14, 22},
                                         {1.3, 21, 28}, {1.7, 15, 17}, {2.2, 8, 8}};
  EXPECT_EQ(suspected_chance(rows), 1.0 / 2.0);
}

TEST(ChanceLevel, TheChanceIsTheLargestThatNoLevelLiesBelow) {
  EXPECT_EQ(suspected_chance({{1, 20, 60}, {2, 21, 60}, {3, 30, 60}, {4, 45, 60}, {5, 58, 60}}),
            1.0 / 3.0);
  EXPECT_EQ(
      suspected_chance({{1, 24, 100}, {2, 26, 100}, {3, 50, 100}, {4, 80, 100}, {5, 98, 100}}),
      1.0 / 4.0);
}

TEST(ChanceLevel, AnswersOfYesAndNoAreNot) {
  EXPECT_FALSE(suspected_chance({{5, 2, 20}, {8, 10, 20}, {12, 17, 20}, {20, 20, 20}}));
  EXPECT_FALSE(suspected_chance({{0.5, 0, 5}, {0.8, 1, 5}, {1.25, 4, 5}, {2, 5, 5}}));
  // Everybody's answers to a thin fluid: the proportion at the lowest level is low, but not
  // near 0.
  EXPECT_FALSE(suspected_chance({{1.093, 14, 65},
                                 {1.237, 17, 65},
                                 {1.646, 26, 65},
                                 {1.7495, 29, 65},
                                 {2.203, 41, 65},
                                 {2.553, 48, 65},
                                 {3.185, 55, 65},
                                 {3.883, 59, 65}}));
  EXPECT_FALSE(suspected_chance({}));
  EXPECT_FALSE(suspected_chance({{1, 0, 0}}));
}

TEST(ChanceLevel, IntensityZeroIsALevelLikeOthers) {
  EXPECT_FALSE(suspected_chance({{0, 1, 30}, {1, 20, 30}, {2, 25, 30}, {3, 30, 30}}));
  EXPECT_TRUE(suspected_chance({{0, 16, 30}, {1, 17, 30}, {2, 25, 30}, {3, 30, 30}}));
}

TEST(ChanceLevel, FewStudiesOfYesAndNoAreSuspectedAndMostForcedChoicesAre) {
  for (const double weber_fraction : {0.2, 0.4, 0.65}) {
    EXPECT_LE(share_suspected(kThin, 5, yes_no(1.853, weber_fraction)), 0.09) << weber_fraction;
    EXPECT_LE(share_suspected(kThin, 65, yes_no(1.853, weber_fraction)), 0.01)
        << weber_fraction;
  }
  EXPECT_GE(share_suspected(kForced, 20, forced(0.5)), 0.9);
  EXPECT_GE(share_suspected(kForced, 50, forced(0.5, 0.03)), 0.85);
  EXPECT_GE(share_suspected(kForced, 50, forced(1.0 / 3.0)), 0.9);
  EXPECT_GE(share_suspected(kForced, 50, forced(0.25)), 0.85);
}

TEST(ChanceLevel, ManyLevelsArePooled) {
  core::RandomStream random(3, "chance level test");
  std::vector<double> intensities;
  for (int level = 0; level < 5000; ++level) intensities.push_back(0.3 + 0.0006 * level);
  EXPECT_EQ(suspected_chance(drawn(intensities, 1, random, forced(0.5))), 0.5);
  EXPECT_FALSE(suspected_chance(drawn(intensities, 1, random, yes_no(1.0, 0.4))));
}

TEST(ChanceLevel, TheWarningNamesTheOption) {
  EXPECT_NE(chance_warning(1.0 / 3.0).find("1/3"), std::string::npos);
  EXPECT_NE(chance_warning(0.5).find("--guess"), std::string::npos);
}

}  // namespace chance_level_test
}  // namespace jnd::analysis
