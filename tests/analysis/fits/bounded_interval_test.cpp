#include "analysis/fits/bounded_interval.h"

#include <gtest/gtest.h>

namespace jnd::analysis {
namespace bounded_interval_test {

void expect_ends(const Interval& shown, std::optional<double> low, std::optional<double> high) {
  EXPECT_EQ(shown.low, low);
  EXPECT_EQ(shown.high, high);
}

TEST(BoundedInterval, AnEndAThousandTimesOffTheEstimateIsOpen) {
  expect_ends(bounded_by_data({0.018, 1.1e20}, 0.9), 0.018, std::nullopt);
  expect_ends(bounded_by_data({2.1e-7, std::nullopt}, 4.513), std::nullopt, std::nullopt);
  expect_ends(bounded_by_data({0.002, 2000.0}, 2.0), 0.002, 2000.0);
  expect_ends(bounded_by_data({0.00199, 2001.0}, 2.0), std::nullopt, std::nullopt);
}

TEST(BoundedInterval, WhatMayBeNegativeOrNothingKeepsItsEnds) {
  expect_ends(bounded_by_data({-0.5, 0.5}, 0.0001), -0.5, 0.5);
  expect_ends(bounded_by_data({-3000.0, -0.1}, -1.0), -3000.0, -0.1);
  expect_ends(bounded_by_data({0.0, 0.2}, 0.05), 0.0, 0.2);
  expect_ends(bounded_by_data({0.1, 1e9}, std::nullopt), 0.1, 1e9);
}

TEST(BoundedInterval, AFactorHasItsUnitAndEveryEndIsTold) {
  expect_ends(told_interval("estimation.k", {1.18e14, 5.73e20}, 2.6e17), 1.18e14, 5.73e20);
  expect_ends(told_interval("group_d.weber_fraction", {0.018, 1.1e20}, 0.9), 0.018,
              std::nullopt);
}

}  // namespace bounded_interval_test
}  // namespace jnd::analysis
