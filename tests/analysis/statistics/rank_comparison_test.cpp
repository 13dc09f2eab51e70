#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statistics/comparison.h"
#include "core/error.h"

namespace jnd::analysis {
namespace rank_comparison_test {

using testing::HasSubstr;

TEST(RankSum, IsExactAndWorkedByHand) {
  // The ranks of a are 3, 5, 6 of 1 to 6, so the sum is 14, and U = 14 - 6 = 8 of 9. Of 20
  // arrangements, U = 9 comes once and U = 8 once: p = 2 * 2 / 20.
  const Comparison result = rank_sum_test({3, 5, 6}, {1, 2, 4});
  EXPECT_EQ(result.status, FitStatus::kOk);
  EXPECT_EQ(*result.statistic, 8.0);
  EXPECT_DOUBLE_EQ(*result.p_value, 0.2);
  EXPECT_NEAR(*result.rank_biserial, 2.0 * 8.0 / 9.0 - 1.0, 1e-15);
  // The differences are -1, 1, 1, 2, 2, 3, 4, 4, 5.
  EXPECT_EQ(*result.hodges_lehmann, 2.0);
  EXPECT_FALSE(result.hodges_lehmann_ci95.low) << "three and three can reject nothing";
  EXPECT_THAT(result.method, HasSubstr("exact"));
}

TEST(RankSum, SwappingTheGroupsOnlyTurnsTheSign) {
  const std::vector<double> a = {1.5, 0.2, 3.1, 2.2, 4.0, 5.5}, b = {0.1, 0.9, 1.4, 2.0, 0.3};
  const Comparison one = rank_sum_test(a, b), other = rank_sum_test(b, a);
  EXPECT_DOUBLE_EQ(*one.p_value, *other.p_value);
  EXPECT_DOUBLE_EQ(*one.rank_biserial, -*other.rank_biserial);
  EXPECT_DOUBLE_EQ(*one.hodges_lehmann, -*other.hodges_lehmann);
  EXPECT_DOUBLE_EQ(*one.hodges_lehmann_ci95.low, -*other.hodges_lehmann_ci95.high);
}

TEST(RankSum, OnlyTheOrderOfTheValuesCounts) {
  const std::vector<double> a = {0.3, 1.2, 2.5, 3.0}, b = {0.1, 0.7, 1.9};
  std::vector<double> exp_a, exp_b;
  for (const double value : a) exp_a.push_back(std::exp(value));
  for (const double value : b) exp_b.push_back(std::exp(value));
  EXPECT_EQ(rank_sum_test(a, b).p_value, rank_sum_test(exp_a, exp_b).p_value);
}

TEST(RankSum, SaysWhyThereIsNone) {
  const Comparison alike = rank_sum_test({2, 2, 2}, {2, 2});
  EXPECT_EQ(alike.status, FitStatus::kDegenerate);
  EXPECT_THAT(alike.reason, HasSubstr("alike"));
  EXPECT_FALSE(alike.p_value.has_value());
  EXPECT_THAT(rank_sum_test({}, {1.0}).reason, HasSubstr("too few"));
  EXPECT_THROW((void)rank_sum_test({std::nan("")}, {1.0}), core::Error);
  const Comparison huge = rank_sum_test({1.7e308, 1.6e308}, {-1.7e308});
  EXPECT_FALSE(huge.estimate.has_value()) << "past the range of numbers, not infinite";
  EXPECT_FALSE(huge.hodges_lehmann.has_value());
}

TEST(Spearman, IsPearsonsCorrelationOfTheRanks) {
  // The ranks are 1, 2.5, 2.5, 4 and 2, 1, 3, 4.
  const Comparison ranks = spearman_correlation({10, 20, 20, 70}, {5, 1, 6, 9});
  const Comparison by_hand = pearson_correlation({1, 2.5, 2.5, 4}, {2, 1, 3, 4});
  EXPECT_DOUBLE_EQ(*ranks.estimate, *by_hand.estimate);
  EXPECT_LT(*ranks.ci95.low, *by_hand.ci95.low) << "Bonett and Wright's is wider";
}

TEST(Spearman, WithoutSpreadOrOfTwoIsDegenerate) {
  const Comparison constant = spearman_correlation({1, 1, 1}, {1, 2, 3});
  EXPECT_EQ(constant.status, FitStatus::kDegenerate);
  EXPECT_FALSE(constant.estimate.has_value());
  EXPECT_THAT(spearman_correlation({1, 2}, {1, 2}).reason, HasSubstr("too few"));
}

TEST(Spearman, FullAgreementHasAPValueAndNoInterval) {
  const Comparison full = spearman_correlation({1, 2, 3, 4}, {1, 8, 27, 64});
  EXPECT_EQ(full.status, FitStatus::kOk) << full.reason;
  EXPECT_DOUBLE_EQ(*full.estimate, 1.0);
  EXPECT_DOUBLE_EQ(*full.p_value, 2.0 / 24.0);
  EXPECT_EQ(*full.statistic, 0.0);
  EXPECT_EQ(full.reason, "");
  EXPECT_FALSE(full.ci95.low || full.ci95.high);
  // With a tie of three among 15 values, 2 * 3! of 15! pairings are as extreme.
  std::vector<double> many = {1, 1, 1};
  for (int i = 2; many.size() < 15; ++i) many.push_back(i);
  const Comparison of_many = spearman_correlation(many, many);
  EXPECT_NEAR(*of_many.p_value * std::tgamma(16.0), 12.0, 1e-6);
  EXPECT_THAT(of_many.method, HasSubstr("exact"));
}

TEST(Spearman, BeyondFourteenPairsThePValueIsThatOfT) {
  std::vector<double> a, b;
  for (int i = 0; i < 15; ++i) {
    a.push_back(i);
    b.push_back(i % 4 == 0 ? -i : i);
  }
  const Comparison of_15 = spearman_correlation(a, b);
  EXPECT_THAT(of_15.method, HasSubstr("p by t"));
  EXPECT_EQ(*of_15.degrees_of_freedom, 13.0);
  ASSERT_EQ(of_15.all_statistics().size(), 2U);
  EXPECT_EQ(of_15.all_statistics()[0].first, "t");
  EXPECT_EQ(of_15.all_statistics()[1].first, "S");
  a.pop_back();
  b.pop_back();
  const Comparison of_14 = spearman_correlation(a, b);
  EXPECT_THAT(of_14.method, HasSubstr(", exact"));
  EXPECT_FALSE(of_14.degrees_of_freedom);
  EXPECT_NEAR(*of_14.p_value, *of_15.p_value, 0.1) << "about the same";
}

TEST(RankSum, TiesAreExactUpToFiftyValues) {
  const Comparison tied = rank_sum_test({1, 1, 1}, {2, 2, 2});
  EXPECT_DOUBLE_EQ(*tied.p_value, 0.1);
  EXPECT_THAT(tied.method, HasSubstr("exact with ties"));
  EXPECT_EQ(tied.statistic_name, "U");
  std::vector<double> a(25, 1.0), b(25, 1.0);
  b.back() = 2.0;
  EXPECT_THAT(rank_sum_test(a, b).method, HasSubstr("exact"));
  // The one larger value is in b, and it could as well be in the other group.
  EXPECT_NEAR(*rank_sum_test(a, b).p_value, 1.0, 1e-12);
  b.push_back(2.0);
  EXPECT_THAT(rank_sum_test(a, b).method, HasSubstr("corrected for ties and continuity"));
}

TEST(Wilcoxon, NamesItsStatisticsAndWhatWasLeftOut) {
  // In R's `sleep`, V = 0 for nine differences, after one difference of 0 is left out.
  const Comparison sleep = wilcoxon_test({0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0},
                                         {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4});
  EXPECT_DOUBLE_EQ(*sleep.p_value, 2.0 / 512.0);
  EXPECT_EQ(sleep.statistic_name, "T");
  EXPECT_EQ(sleep.all_statistics(),
            (std::vector<std::pair<std::string, double>>{{"V", 0.0}, {"T", 0.0}}));
  EXPECT_EQ(sleep.num_zeros, 1);
  EXPECT_THAT(sleep.method, HasSubstr("exact with ties, without 1 difference of 0"));
}

TEST(Wilcoxon, DifferencesThatOnlyRoundingTellsApartAreTied) {
  const std::vector<double> a = {1.3, 1.5, 0.6, 2.3, 0.4}, b = {1.2, 1.4, 0.5, 2.2, 0.3};
  EXPECT_DOUBLE_EQ(*wilcoxon_test(a, b).p_value, 0.0625);
  EXPECT_THAT(wilcoxon_test(a, b).method, HasSubstr("with ties"));
  EXPECT_EQ(wilcoxon_test({0.3, 1.0}, {0.1 + 0.2, 0.0}).num_zeros, 1);
}

/// One pair of large values must not turn small differences into 0.
TEST(Wilcoxon, EveryDifferenceIsAsExactAsItsOwnPair) {
  std::vector<double> a = {1e12}, b = {1e12 - 5.0};
  for (int i = 1; i <= 8; ++i) {
    a.push_back(0.001 * i);
    b.push_back(0.00099 * i);
  }
  const Comparison test = wilcoxon_test(a, b);
  EXPECT_EQ(test.num_zeros, 0);
  EXPECT_DOUBLE_EQ(*test.p_value, 2.0 / 512.0);
}

TEST(OneSample, IsThePairedTestAgainstZeros) {
  const std::vector<double> values = {0.4, 1.1, -0.3, 2.0};
  const Comparison one = one_sample_t_test(values);
  const Comparison paired = paired_t_test(values, std::vector<double>(values.size(), 0.0));
  EXPECT_DOUBLE_EQ(*one.p_value, *paired.p_value);
  EXPECT_DOUBLE_EQ(*one.cohen_dz, *paired.cohen_dz);
  EXPECT_THAT(one_sample_t_test({1.0}).reason, HasSubstr("too few"));
  EXPECT_THAT(one_sample_t_test({2.0, 2.0}).reason, HasSubstr("alike"));
}

}  // namespace rank_comparison_test
}  // namespace jnd::analysis
