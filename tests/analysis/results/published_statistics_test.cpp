#include "analysis/results/published_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace jnd::analysis {
namespace published_statistics_test {

using Kind = PublishedStatistic::Kind;
using Summary = PublishedStatistic::Summary;

/// Returns a person with ten answers each at 8 / 1.5 and 8 * 1.5, of which this many are right.
PersonOutcome person(int num_right, const std::string& block = "thin") {
  PersonOutcome one;
  one.numbers[block + ".reference"] = 8.0;
  const double below = 8.0 / 1.5, above = 8.0 * 1.5;
  one.counts[block][below] = {.intensity = below, .num_yes = 10 - num_right, .num_trials = 10};
  one.counts[block][above] = {.intensity = above, .num_yes = num_right, .num_trials = 10};
  return one;
}

/// F(ln 1.5 / ln(1 + w)) = share. The distance of a share from 1/2 in standard deviations is
/// taken from a table of the normal distribution.
double fraction_at(double standard_deviations) {
  return std::exp(std::log(1.5) / standard_deviations) - 1.0;
}
constexpr double kAtEight = 0.8416212335729143, kAtNine = 1.2815515655446004;

class PublishedStatisticsTest : public ::testing::Test {
 protected:
  std::optional<double> value(const PublishedStatistic& statistic) {
    std::vector<std::size_t> all(people_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    return PublishedStatistics(people_).value(statistic, all);
  }
  std::vector<PersonOutcome> people_;
};

TEST_F(PublishedStatisticsTest, OwnWeberFractionsAreLeastSquaresWithThePseAtTheReference) {
  people_ = {person(8), person(9)};
  const double eight = fraction_at(kAtEight), nine = fraction_at(kAtNine);
  PublishedStatistic own{.kind = Kind::kOwnWeberFractions, .block = "thin"};
  EXPECT_NEAR(*value(own), 0.5 * (eight + nine), 1e-8);
  own.summary = Summary::kStandardDeviation;
  EXPECT_NEAR(*value(own), (eight - nine) / std::sqrt(2.0), 1e-8);
  // In the pooled answers, 17 of 20 are right.
  constexpr double kAtSeventeen = 1.0364333894937898;
  EXPECT_NEAR(*value({.kind = Kind::kPooledWeberFraction, .block = "thin"}),
              fraction_at(kAtSeventeen), 1e-8);
  EXPECT_FALSE(value({.kind = Kind::kPooledWeberFraction, .block = "thick"}));
  EXPECT_FALSE(value({.kind = Kind::kOwnWeberFractions, .block = "thick"}));
}

TEST_F(PublishedStatisticsTest, NobodyIsLeftOutForAnExtremeFraction) {
  people_ = {person(8), person(10)};
  PublishedStatistic own{.kind = Kind::kOwnWeberFractions, .block = "thin"};
  EXPECT_NEAR(*value(own), 0.5 * fraction_at(kAtEight), 1e-8) << "separated: 0";
  people_ = {person(8), person(5)};
  EXPECT_EQ(*value(own), std::numeric_limits<double>::infinity()) << "flat";
  own.summary = Summary::kMedian;
  EXPECT_EQ(*value(own), std::numeric_limits<double>::infinity()) << "of two";
}

TEST_F(PublishedStatisticsTest, CountsThoseWhoseOwnFractionIsAboveThePooledOneOfAnotherBlock) {
  for (const int num_right : {6, 7, 9, 10}) {
    people_.push_back(person(num_right, "thick"));
    PersonOutcome& one = people_.back();
    const PersonOutcome thin = person(8);
    one.counts["thin"] = thin.counts.at("thin");
    one.numbers["thin.reference"] = 8.0;
  }
  const PublishedStatistic above{
      .kind = Kind::kNumOwnAbovePooled, .block = "thick", .other_block = "thin"};
  EXPECT_EQ(value(above), 2.0);
}

TEST_F(PublishedStatisticsTest, RatiosAreEverybodysOwn) {
  for (const double at_double : {6.0, 8.0}) {
    people_.emplace_back().means["production"] = {
        {50.0, 1.0}, {100.0, 2.0}, {200.0, at_double}};
  }
  people_.emplace_back().means["production"] = {{100.0, 2.0}};
  PublishedStatistic ratio{.kind = Kind::kProductionRatio,
                           .block = "production",
                           .high_target = 200.0,
                           .low_target = 100.0};
  EXPECT_NEAR(*value(ratio), 3.5, 1e-12) << "who lacks a target has none";
  ratio.summary = Summary::kStandardDeviation;
  EXPECT_NEAR(*value(ratio), std::sqrt(0.5), 1e-12);
}

TEST_F(PublishedStatisticsTest, NumbersAreSummedUpOverPeopleAndNames) {
  for (const double x : {1.0, 2.0, 6.0}) {
    PersonOutcome& one = people_.emplace_back();
    one.numbers = {{"a", x}, {"b", 10.0 * x}};
  }
  EXPECT_EQ(value({.kind = Kind::kNumbers, .names = {"a"}}), 3.0);
  EXPECT_EQ(value({.kind = Kind::kNumbers, .summary = Summary::kMedian, .names = {"a", "b"}}),
            8.0);
  EXPECT_EQ(value({.kind = Kind::kDifferenceOfMeans, .names = {"b", "a"}}), 27.0);
  EXPECT_FALSE(value({.kind = Kind::kNumbers, .names = {"none"}}));
  EXPECT_FALSE(value({.kind = Kind::kDifferenceOfMeans, .names = {"a", "none"}}));
}

/// Schmidt (2018), eq. D.5, gives the law between the two curves in D.3 and D.4: 0.5145 and
/// 0.9021.
TEST_F(PublishedStatisticsTest, TheLawBetweenEstimationAndProductionIsThatOfThePublication) {
  PersonOutcome& one = people_.emplace_back();
  const core::PowerFunction estimation{0.6663, 0.6386}, production{0.3761, 1.206};
  for (int step = 0; step <= 8; ++step) {
    one.means["estimation"][0.5 * step] = estimation.magnitude(0.5 * step);
  }
  for (const double percent : {50.0, 100.0, 200.0}) {
    one.means["production"][percent] = production.intensity_at(percent / 100.0);
  }
  people_.push_back(one);
  PublishedStatistic law{
      .kind = Kind::kCombinedPowerLaw, .block = "estimation", .other_block = "production"};
  EXPECT_NEAR(*value(law), 0.5145, 5e-5);
  law.is_exponent = true;
  EXPECT_NEAR(*value(law), 0.9021, 4e-4) << "the coefficients are rounded to four digits";
  law = {.kind = Kind::kEstimationPowerLaw, .block = "estimation", .is_exponent = true};
  EXPECT_NEAR(*value(law), 0.6386, 1e-8);
  law = {.kind = Kind::kProductionPowerLaw, .block = "production"};
  EXPECT_NEAR(*value(law), 0.3761, 1e-8);
}

TEST_F(PublishedStatisticsTest, OnlyThoseDrawnCount) {
  for (const double x : {1.0, 2.0, 6.0}) people_.emplace_back().numbers["a"] = x;
  PublishedStatistics statistics(people_);
  const PublishedStatistic mean{.kind = Kind::kNumbers, .names = {"a"}};
  EXPECT_EQ(statistics.value(mean, {0, 1}), 1.5);
  EXPECT_EQ(statistics.value(mean, {2}), 6.0);
  EXPECT_EQ(statistics.averaged(mean, {0, 2}), (std::vector<double>{1.0, 6.0}));
}

}  // namespace published_statistics_test
}  // namespace jnd::analysis
