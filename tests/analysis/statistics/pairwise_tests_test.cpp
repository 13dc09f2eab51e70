#include "analysis/statistics/pairwise_tests.h"

#include <gtest/gtest.h>

namespace pairwise_tests_test {

using namespace jnd::analysis;

const RepeatedMeasures kMeasured = {
    .people = {"P1", "P2", "P3", "P4", "P5"},
    .conditions = {"thin", "thick", "solid"},
    .values = {
        {4.1, 5.2, 6.9}, {3.0, 3.8, 6.1}, {5.5, 5.0, 7.7}, {4.4, 6.1, 6.0}, {2.9, 4.0, 5.8}}};

TEST(PairwiseTests, OfPairedTAreWhatRSays) {
  // R 4.2.2: t.test(a, b, paired = TRUE) of each pair, and p.adjust(p, "holm").
  const std::vector<PairwiseTest> tests = pairwise_tests(kMeasured, PairwiseMethod::kPairedT);
  ASSERT_EQ(tests.size(), 3u);
  EXPECT_EQ(tests[0].a + tests[0].b, "thinthick");
  EXPECT_EQ(tests[1].a + tests[1].b, "thinsolid");
  EXPECT_EQ(tests[2].a + tests[2].b, "thicksolid");
  EXPECT_NEAR(*tests[0].comparison.p_value, 0.083109139433894, 1e-12);
  EXPECT_NEAR(*tests[1].comparison.p_value, 0.000782841755948, 1e-12);
  EXPECT_NEAR(*tests[0].p_value_holm, 0.08310913943389, 1e-12);
  EXPECT_NEAR(*tests[1].p_value_holm, 0.00234852526784, 1e-12);
  EXPECT_NEAR(*tests[2].p_value_holm, 0.04979232692045, 1e-12);
  EXPECT_LT(*tests[1].comparison.estimate, 0.0) << "thin minus solid";
}

TEST(PairwiseTests, OfRanksAreWhatRSays) {
  // R 4.2.2: wilcox.test(a, b, paired = TRUE) of each pair, and p.adjust(p, "holm"). The
  // differences have no ties but in the third pair, where both are exact as well.
  const std::vector<PairwiseTest> tests = pairwise_tests(kMeasured, PairwiseMethod::kWilcoxon);
  EXPECT_NEAR(*tests[0].comparison.p_value, 0.125, 1e-12);
  EXPECT_NEAR(*tests[1].comparison.p_value, 0.0625, 1e-12);
  EXPECT_NEAR(*tests[1].p_value_holm, 0.1875, 1e-12);
}

TEST(PairwiseTests, APairWithoutATestIsNotCountedAmongThem) {
  RepeatedMeasures data = kMeasured;
  for (std::vector<double>& person : data.values) person[1] = person[0] + 1.0;
  const std::vector<PairwiseTest> tests = pairwise_tests(data, PairwiseMethod::kPairedT);
  EXPECT_FALSE(tests[0].p_value_holm) << "everybody changes alike";
  EXPECT_NEAR(*tests[1].p_value_holm, 2.0 * *tests[1].comparison.p_value, 1e-12)
      << "two pairs are left, and both have the same p value";
}

}  // namespace pairwise_tests_test
