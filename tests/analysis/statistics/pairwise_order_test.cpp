#include "analysis/statistics/pairwise_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace pairwise_order_test {

TEST(PairwiseOrder, AgreesWithSortingEveryPair) {
  const std::vector<double> a = {-3.5, -1.0, -0.0, 0.0, 0.1, 2.0, 2.0, 1e-300, 7.25, 1e12};
  const std::vector<double> b = {-2.0, -2.0, 0.3, 0.7, 1e6};
  std::vector<double> ascending = a, means, differences;
  std::sort(ascending.begin(), ascending.end());
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    for (std::size_t j = i; j < ascending.size(); ++j) {
      means.push_back(0.5 * ascending[i] + 0.5 * ascending[j]);
    }
    for (const double y : b) differences.push_back(ascending[i] - y);
  }
  std::sort(means.begin(), means.end());
  std::sort(differences.begin(), differences.end());
  for (std::size_t i = 0; i < means.size(); ++i) {
    EXPECT_EQ(walsh_average_at(ascending, i), means[i]) << i;
  }
  for (std::size_t i = 0; i < differences.size(); ++i) {
    EXPECT_EQ(difference_at(ascending, b, i), differences[i]) << i;
  }
}

TEST(PairwiseOrder, HasNoNegativeZero) {
  EXPECT_FALSE(std::signbit(walsh_average_at({-1.0, 1.0}, 1)));
  EXPECT_FALSE(std::signbit(difference_at({-0.0}, {0.0}, 0)));
}

TEST(PairwiseOrder, PastTheRangeOfNumbersIsInfinite) {
  EXPECT_TRUE(std::isinf(difference_at({1.7e308}, {-1.7e308}, 0)));
  EXPECT_EQ(walsh_average_at({1.7e308}, 0), 1.7e308);
}

TEST(PairwiseOrder, CountsAMillionValuesWithoutTheirPairs) {
  std::vector<double> many(1'000'000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<double>(i);
  const std::size_t pairs = many.size() * (many.size() + 1) / 2;
  EXPECT_NEAR(walsh_average_at(many, pairs / 2), 0.5 * 999'999.0, 1.0);
}

}  // namespace pairwise_order_test
}  // namespace jnd::analysis
