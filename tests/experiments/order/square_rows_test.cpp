#include "experiments/order/square_rows.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

namespace jnd::experiments {
namespace square_rows_test {

/// Returns how often each item stands in each place.
std::map<std::pair<std::size_t, std::size_t>, int> places_of(const OrderRows& rows) {
  std::map<std::pair<std::size_t, std::size_t>, int> counts;
  for (const auto& row : rows) {
    for (std::size_t place = 0; place < row.size(); ++place) ++counts[{row[place], place}];
  }
  return counts;
}

/// Returns how often each item follows each other item.
std::map<std::pair<std::size_t, std::size_t>, int> followers_of(const OrderRows& rows) {
  std::map<std::pair<std::size_t, std::size_t>, int> counts;
  for (const auto& row : rows) {
    for (std::size_t place = 1; place < row.size(); ++place) {
      ++counts[{row[place - 1], row[place]}];
    }
  }
  return counts;
}

template <typename Counts>
void expect_each(const Counts& counts, std::size_t num, int times) {
  EXPECT_EQ(counts.size(), num);
  for (const auto& [pair, count] : counts) EXPECT_EQ(count, times);
}

TEST(SquareRows, OfALatinSquareOfThreeRunInCircles) {
  EXPECT_EQ(latin_rows(3), (OrderRows{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}));
}

TEST(SquareRows, OfAWilliamsSquareOfFourAreThePublishedOnes) {
  // Williams 1949, written from 0, has the first row 0, 1, 3, 2.
  EXPECT_EQ(williams_rows(4),
            (OrderRows{{0, 1, 3, 2}, {1, 2, 0, 3}, {2, 3, 1, 0}, {3, 0, 2, 1}}));
}

TEST(SquareRows, PutEveryItemEquallyOftenIntoEveryPlace) {
  for (std::size_t n = 1; n <= 12; ++n) {
    expect_each(places_of(latin_rows(n)), n * n, 1);
    expect_each(places_of(williams_rows(n)), n * n, n % 2 == 1 && n > 1 ? 2 : 1);
  }
}

TEST(SquareRows, OfAWilliamsSquareHaveEveryItemFollowEveryOtherEquallyOften) {
  for (std::size_t n = 2; n <= 12; ++n) {
    expect_each(followers_of(williams_rows(n)), n * (n - 1), n % 2 == 1 ? 2 : 1);
  }
}

TEST(SquareRows, OfALatinSquareHaveTheSameItemsFollowEachOther) {
  expect_each(followers_of(latin_rows(5)), 5, 4);
}

}  // namespace square_rows_test
}  // namespace jnd::experiments
