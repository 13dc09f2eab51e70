#include "analysis/statistics/omnibus_test.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace omnibus_test_test {

using namespace jnd::analysis;

RepeatedMeasures measured(std::vector<std::vector<double>> values) {
  RepeatedMeasures data{.people = {}, .conditions = {}, .values = std::move(values)};
  for (std::size_t i = 0; i < data.values.size(); ++i) {
    data.people.push_back("P" + std::to_string(i));
  }
  for (std::size_t i = 0; i < data.values.front().size(); ++i) {
    data.conditions.push_back("c" + std::to_string(i));
  }
  return data;
}

const RepeatedMeasures kFive = measured(
    {{4.1, 5.2, 6.9}, {3.0, 3.8, 6.1}, {5.5, 5.0, 7.7}, {4.4, 6.1, 6.0}, {2.9, 4.0, 5.8}});

TEST(RepeatedMeasuresAnova, OfTwoConditionsIsThePairedTestSquared) {
  // The differences 1, 2, 1, 4 give t = 2 sqrt 2 with 3 degrees of freedom, so F = 8 with 1 and
  // 3.
  const OmnibusTest test = repeated_measures_anova(measured({{1, 0}, {3, 1}, {4, 3}, {8, 4}}));
  EXPECT_NEAR(*test.statistic, 8.0, 1e-12);
  EXPECT_EQ(test.degrees_of_freedom, 1.0);
  EXPECT_EQ(test.error_degrees_of_freedom, 3.0);
  EXPECT_NEAR(test.greenhouse_geisser->epsilon, 1.0, 1e-12);
  EXPECT_NEAR(test.greenhouse_geisser->p_value, *test.p_value, 1e-12);
  // The sums of squares are 8 for conditions, 3 for errors, and 2 * (1/4 + ...) for people,
  // from the means .5, 2, 3.5, 6.
  EXPECT_NEAR(*test.partial_eta_squared, 8.0 / 11.0, 1e-12);
  EXPECT_NEAR(*test.generalized_eta_squared, 8.0 / (11.0 + 33.0), 1e-12);
}

TEST(RepeatedMeasuresAnova, OfThreeConditionsIsWhatRSays) {
  // The values are from R 4.2.2: anova(lm(d ~ 1), X = ~1, test = "Spherical").
  const OmnibusTest test = repeated_measures_anova(kFive);
  EXPECT_NEAR(*test.statistic, 22.48157, 1e-5);
  EXPECT_NEAR(*test.p_value, 0.0005205534455, 1e-12);
  EXPECT_NEAR(test.greenhouse_geisser->epsilon, 0.724101037319, 1e-10);
  EXPECT_NEAR(test.greenhouse_geisser->p_value, 0.002476868934, 1e-11);
  EXPECT_EQ(test.huynh_feldt->epsilon, 1.0) << "1.0269, and no more than 1";
}

TEST(RepeatedMeasuresAnova, MauchlysTestOfSphericityIsWhatRSays) {
  // R 4.2.2: mauchly.test(lm(values ~ 1), X = ~1), of three and of four conditions. In one term
  // of the second order R takes the number of conditions instead of that of contrasts (of four
  // conditions it says 0.761645850298); the formula of Anderson with the contrasts gives ours.
  const OmnibusTest three = repeated_measures_anova(kFive);
  ASSERT_TRUE(three.mauchly);
  EXPECT_NEAR(three.mauchly->w, 0.618977258062, 1e-11);
  EXPECT_NEAR(three.mauchly->p_value, 0.486981024774, 1e-11);
  RepeatedMeasures more = kFive;
  const double fourth[] = {5.0, 7.2, 6.6, 7.1, 5.0};
  for (std::size_t i = 0; i < 5; ++i) more.values[i].push_back(fourth[i]);
  const OmnibusTest four = repeated_measures_anova(more);
  ASSERT_TRUE(four.mauchly);
  EXPECT_NEAR(four.mauchly->w, 0.371824027289, 1e-11);
  EXPECT_NEAR(four.mauchly->p_value, 0.76128964122736, 1e-11);
  EXPECT_FALSE(repeated_measures_anova(measured({{1, 0}, {3, 1}, {4, 3}})).mauchly)
      << "two conditions have one difference";
}

TEST(RepeatedMeasuresAnova, PeopleWhoDifferAndConditionsThatDoNotAreNoEffect) {
  RepeatedMeasures far_apart = kFive;
  for (std::size_t person = 0; person < 5; ++person) {
    for (double& value : far_apart.values[person]) value += 100.0 * static_cast<double>(person);
  }
  EXPECT_NEAR(*repeated_measures_anova(far_apart).statistic,
              *repeated_measures_anova(kFive).statistic, 1e-6);
}

TEST(RepeatedMeasuresAnova, WithoutErrorsOrPeopleItSaysWhy) {
  const OmnibusTest alike = repeated_measures_anova(measured({{1, 2, 4}, {11, 12, 14}}));
  EXPECT_EQ(alike.status, FitStatus::kDegenerate);
  EXPECT_NE(alike.reason.find("F is infinite"), std::string::npos);
  EXPECT_FALSE(alike.p_value.has_value());
  const OmnibusTest same = repeated_measures_anova(measured({{1, 1, 1}, {7, 7, 7}}));
  EXPECT_EQ(same.status, FitStatus::kDegenerate);
  EXPECT_NE(same.reason.find("nothing to test"), std::string::npos) << same.reason;
  EXPECT_EQ(repeated_measures_anova(measured({{1, 2, 4}})).status, FitStatus::kDegenerate);
  EXPECT_THROW((void)repeated_measures_anova(
                   measured({{1, std::numeric_limits<double>::quiet_NaN()}, {1, 2}})),
               std::exception);
}

TEST(FriedmanTest, IsWhatRSaysWithAndWithoutTies) {
  const OmnibusTest plain = friedman_test(kFive);
  EXPECT_NEAR(*plain.statistic, 6.4, 1e-12);
  EXPECT_NEAR(*plain.p_value, 0.04076220397836621, 1e-12) << "exp(-3.2)";
  EXPECT_NEAR(*plain.concordance, 0.64, 1e-12);
  const OmnibusTest tied =
      friedman_test(measured({{1, 1, 2}, {2, 3, 3}, {1, 2, 3}, {4, 4, 4}}));
  EXPECT_NEAR(*tied.statistic, 5.0, 1e-12);
  EXPECT_NEAR(*tied.p_value, 0.0820849986239, 1e-12);
}

TEST(FriedmanTest, AllAlikeIsNothingToRank) {
  EXPECT_EQ(friedman_test(measured({{1, 1}, {2, 2}})).status, FitStatus::kDegenerate);
}

}  // namespace omnibus_test_test
