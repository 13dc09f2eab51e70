#include "analysis/fits/falling_test.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jnd::analysis {
namespace falling_test_test {

using Rows = std::vector<AnswerCount>;

/// Returns the share of all placements of the "yes" over single trials that lie as low or
/// lower. The function enumerates all placements.
double by_enumeration(const Rows& rows) {
  std::vector<int> ranks;  // The vector has one entry for each trial.
  int num_yes = 0, observed = 0;
  for (std::size_t level = 0; level < rows.size(); ++level) {
    for (int trial = 0; trial < rows[level].num_trials; ++trial) {
      ranks.push_back(static_cast<int>(level));
    }
    num_yes += static_cast<int>(rows[level].num_yes);
    observed += static_cast<int>(level) * static_cast<int>(rows[level].num_yes);
  }
  int num_placements = 0, num_as_low = 0;
  for (unsigned placement = 0; placement < 1U << ranks.size(); ++placement) {
    int count = 0, sum = 0;
    for (std::size_t trial = 0; trial < ranks.size(); ++trial) {
      if ((placement >> trial & 1U) == 0) continue;
      ++count;
      sum += ranks[trial];
    }
    if (count != num_yes) continue;
    ++num_placements;
    num_as_low += sum <= observed ? 1 : 0;
  }
  return static_cast<double>(num_as_low) / num_placements;
}

TEST(FallingTest, IsFishersExactTestAtTwoLevels) {
  // One of six placements has both "yes" at the lower of two levels with two trials each.
  EXPECT_NEAR(falling_p_value({{4.0, 2, 2}, {16.0, 0, 2}}).value(), 1.0 / 6.0, 1e-15);
  // R: fisher.test(matrix(c(9, 1, 1, 9), 2), alternative = "greater")$p.value
  EXPECT_NEAR(falling_p_value({{4.0, 9, 10}, {16.0, 1, 10}}).value(), 0.000546666955335686,
              1e-15);
}

TEST(FallingTest, CountsEveryPlacementOfTheAnswers) {
  // One "yes" in three trials at three levels lies at the lowest level in one of three
  // placements.
  EXPECT_NEAR(falling_p_value({{1.0, 1, 1}, {2.0, 0, 1}, {3.0, 0, 1}}).value(), 1.0 / 3.0,
              1e-15);
  for (const Rows& rows : {Rows{{1.0, 4, 5}, {2.0, 2, 5}, {5.0, 1, 5}},
                           Rows{{1.0, 0, 3}, {2.0, 2, 3}, {5.0, 3, 3}},
                           Rows{{1.0, 2, 4}, {2.0, 3, 3}, {5.0, 0, 4}, {9.0, 1, 3}}}) {
    EXPECT_NEAR(falling_p_value(rows).value(), by_enumeration(rows), 1e-12);
  }
}

TEST(FallingTest, TakesEachOrderOfTheIntervalsByItself) {
  const Rows rows = {{4.0, 2, 2, kTestFirst},
                     {16.0, 0, 2, kTestFirst},
                     {4.0, 2, 2, kTestSecond},
                     {16.0, 0, 2, kTestSecond}};
  EXPECT_NEAR(falling_p_value(rows).value(), 1.0 / 36.0, 1e-15);
  // A person who always takes the second interval has not misunderstood the question.
  const Rows of_bias = {{4.0, 0, 9, kTestFirst},
                        {16.0, 0, 1, kTestFirst},
                        {4.0, 1, 1, kTestSecond},
                        {16.0, 9, 9, kTestSecond}};
  EXPECT_FALSE(falling_p_value(of_bias).has_value());
}

TEST(FallingTest, OfAnswersThatCannotFallThereIsNone) {
  EXPECT_FALSE(falling_p_value({}).has_value());
  EXPECT_FALSE(falling_p_value({{4.0, 3, 9}}).has_value());
  EXPECT_FALSE(falling_p_value({{4.0, 9, 9}, {16.0, 9, 9}}).has_value());
  EXPECT_FALSE(falling_p_value({{4.0, 0, 9}, {16.0, 0, 9}}).has_value());
  EXPECT_FALSE(falling_p_value({{4.0, 1, 3}, {16.0, 0, 0}}).has_value());
}

TEST(FallingTest, RisingAnswersHaveAPValueNearOne) {
  EXPECT_GT(falling_p_value({{4.0, 1, 10}, {16.0, 9, 10}}).value(), 0.999);
}

TEST(FallingTest, SaysSoWhereChanceHasItInFewerThanOneOfAHundred) {
  EXPECT_FALSE(significant_fall({{4.0, 8, 10}, {16.0, 2, 10}}).has_value()) << "p = 0.0115";
  const Rows rows = {{4.0, 9, 10}, {16.0, 1, 10}};
  EXPECT_EQ(significant_fall(rows), falling_p_value(rows));
  EXPECT_EQ(falling_words(0.0042),
            "the answers fall as the intensity grows (exact trend test, p = 0.004), as of "
            "somebody who answers the wrong way round");
  EXPECT_NE(falling_words(0.0005).find("p < 0.001"), std::string::npos);
}

TEST(FallingTest, BeyondTwoHundredTrialsTheNormalDistributionIsClose) {
  // SciPy: hypergeom.cdf(42, 200, 100, 100) and hypergeom.cdf(42, 202, 100, 101).
  EXPECT_NEAR(falling_p_value({{4.0, 58, 100}, {16.0, 42, 100}}).value(), 0.01681800935765072,
              1e-13);
  EXPECT_NEAR(falling_p_value({{4.0, 58, 101}, {16.0, 42, 101}}).value(), 0.017261874578884968,
              5e-4);
  const double p = falling_p_value({{4.0, 60000, 100000}, {16.0, 50000, 100000}}).value();
  EXPECT_LT(p, 1e-12);
  EXPECT_TRUE(std::isfinite(p));
}

}  // namespace falling_test_test
}  // namespace jnd::analysis
