#include "app/gui/views/scope_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace jnd::app::gui {
namespace scope_curve_test {

constexpr Rect kPlace{0, 0, 200, 50};  // A pixel is 50 ms wide.
constexpr AxisRange kRange{-10.0, 10.0};

/// Returns ten seconds of a slow slope, up or down.
std::vector<ScopePoint> slope(float per_point) {
  std::vector<ScopePoint> points;
  for (int i = 0; i <= 1000; ++i) {
    const float value = per_point * static_cast<float>(i);
    points.push_back({20.0 + 0.01 * i, value, value});
  }
  return points;
}

PlotSeries curve_of(const std::vector<ScopePoint>& points) {
  return scope_curve(points, {.newest_s = points.back().time_s}, kPlace, kRange);
}

TEST(ScopeCurve, KeepsASpikeOfASingleIntervalAtItsWholeHeight) {
  std::vector<ScopePoint> points = slope(0.0f);
  points[503].high = 7.5f;
  points[801].low = -3.25f;
  const PlotSeries curve = curve_of(points);
  EXPECT_EQ(*std::ranges::max_element(curve.y), 7.5);
  EXPECT_EQ(*std::ranges::min_element(curve.y), -3.25);
  const auto spike = std::ranges::max_element(curve.y) - curve.y.begin();
  EXPECT_NEAR(curve.x[static_cast<std::size_t>(spike)], -4.97, 0.05);
}

TEST(ScopeCurve, HasAPointForAColumnOfPixelsWhereMoreCouldNotBeSeen) {
  const PlotSeries curve = curve_of(slope(1e-4f));
  EXPECT_LE(curve.x.size(), 202U);
  EXPECT_GE(curve.x.size(), 199U);
  EXPECT_NEAR(curve.y.front(), 0.0, 1e-3);
  EXPECT_NEAR(curve.y.back(), 0.1, 1e-3);
}

TEST(ScopeCurve, RisesAndFallsAsTheChannelDoes) {
  const PlotSeries rising = curve_of(slope(0.1f));
  EXPECT_TRUE(std::ranges::is_sorted(rising.y));
  EXPECT_TRUE(std::ranges::is_sorted(rising.x));
  PlotSeries falling = curve_of(slope(-0.1f));
  EXPECT_EQ(falling.y.size(), rising.y.size());
  EXPECT_EQ(falling.y[2], -rising.y[2]) << "the same, upside down";
  std::ranges::reverse(falling.y);
  EXPECT_TRUE(std::ranges::is_sorted(falling.y));
}

TEST(ScopeCurve, IsBrokenWhereSamplesWereLostOrAreNoNumbers) {
  std::vector<ScopePoint> points = slope(0.0f);
  points.erase(points.begin() + 300, points.begin() + 302);
  const auto num_gaps = [](const PlotSeries& curve) {
    return std::ranges::count_if(curve.y, [](double value) { return std::isnan(value); });
  };
  EXPECT_EQ(num_gaps(curve_of(points)), 1);
  EXPECT_EQ(num_gaps(curve_of(slope(0.0f))), 0);
  points = slope(0.0f);
  for (std::size_t i = 400; i < 420; ++i) points[i].low = points[i].high = std::nanf("");
  EXPECT_GE(num_gaps(curve_of(points)), 1);
}

TEST(ScopeRange, HoldsAllPointsCloselyAndDoesNotMoveWithEveryOfThem) {
  std::vector<ScopePoint> points = slope(0.001f);
  points[500].low = -0.28f;
  const AxisRange range = scope_range(points, "m");
  EXPECT_LE(range.low, -0.28);
  EXPECT_GE(range.high, 1.0);
  EXPECT_LT(range.high - range.low, 1.28 * 1.3);
  points.push_back({30.01, 1.001f, 1.001f});
  points.push_back({30.02, -0.281f, 0.5f});
  EXPECT_EQ(scope_range(points, "m").low, range.low);
}

TEST(ScopeRange, IsNeverSmallerThanWhatIsOfInterest) {
  for (const char* unit : {"m", "m/s", "rad", "N", "N m", ""}) {
    const AxisRange range = scope_range(slope(1e-18f), unit);
    EXPECT_GE(range.high - range.low, least_scope_span(unit)) << unit;
    EXPECT_LE(range.low, 0.0) << unit;
    const AxisRange none = scope_range({}, unit);
    EXPECT_LT(none.low, none.high) << unit;
    const float nan = std::nanf("");
    const AxisRange broken = scope_range({{0.0, nan, nan}}, unit);
    EXPECT_LT(broken.low, broken.high) << unit;
  }
}

}  // namespace scope_curve_test
}  // namespace jnd::app::gui
