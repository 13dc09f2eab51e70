#include "core/media/force_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/random_stream.h"
#include "support/allocation_counter.h"

namespace jnd::core {
namespace force_map_test {

constexpr double kRightAngle = std::numbers::pi / 2.0;

double thesis_fit(double angle) { return 0.5794 - 0.3105 * std::cos(2.0 * angle); }

/// Returns a map with a row every 5 degrees, as in the shipped one.
ForceMap thesis_map() {
  std::vector<ForceMap::Row> rows;
  for (int i = 0; i <= 18; ++i) {
    const double angle = kRightAngle * i / 18;
    rows.push_back({angle, 1.0, thesis_fit(angle), 0.0});
  }
  return ForceMap(rows);
}

ForceMap two_speeds() {
  return ForceMap({{0.0, 0.5, 0.2, 0.0},
                   {0.8, 0.5, 0.6, 0.5},
                   {kRightAngle, 0.5, 1.0, 0.0},
                   {0.0, 1.5, 0.4, 0.0},
                   {0.8, 1.5, 0.8, 0.9},
                   {kRightAngle, 1.5, 1.4, 0.0}});
}

TEST(ForceMap, GoesThroughItsRows) {
  const ForceMap map = two_speeds();
  EXPECT_NEAR(map.at(0.8, 0.5).drag, 0.6, 1e-15);
  EXPECT_NEAR(map.at(0.8, 1.5).lift, 0.9, 1e-15);
  EXPECT_NEAR(map.at(kRightAngle, 1.5).drag, 1.4, 1e-15);
  EXPECT_TRUE(map.has_lift());
  EXPECT_FALSE(thesis_map().has_lift());
}

TEST(ForceMap, IsLinearInSpeedAndStaysBeyondItsEnds) {
  const ForceMap map = two_speeds();
  EXPECT_NEAR(map.at(0.8, 1.0).drag, 0.7, 1e-15);
  EXPECT_NEAR(map.at(0.8, 1.25).lift, 0.8, 1e-15);
  EXPECT_EQ(map.at(0.8, 0.0).drag, map.at(0.8, 0.5).drag);
  EXPECT_EQ(map.at(0.8, 1e300).drag, map.at(0.8, 1.5).drag);
  EXPECT_EQ(map.at(-3.0, 1.0).drag, map.at(0.0, 1.0).drag);
  EXPECT_EQ(map.at(9.0, 1.0).drag, map.at(kRightAngle, 1.0).drag);
}

TEST(ForceMap, TheThesissFitSampledComesBackWithinAThousandth) {
  const ForceMap map = thesis_map();
  for (double angle = 0.0; angle <= kRightAngle; angle += 0.001) {
    ASSERT_NEAR(map.at(angle, 0.4).drag, thesis_fit(angle), 1e-3) << angle;
  }
  HandMotion motion = {.speed_m_per_s = 0.7, .sin_angle_of_attack = 0.6};
  EXPECT_NEAR(mapped_drag_coefficient(motion, &map), mapped_drag_coefficient(motion, nullptr),
              1e-3);
}

TEST(ForceMap, DragIsFlatWhereItIsEven) {
  const ForceMap map(
      {{0.0, 1.0, 0.2, 0.0}, {0.5, 1.0, 0.4, 0.0}, {kRightAngle, 1.0, 0.9, 0.0}});
  EXPECT_NEAR((map.at(1e-4, 1.0).drag - map.at(0.0, 1.0).drag) / 1e-4, 0.0, 1e-3);
  EXPECT_NEAR((map.at(kRightAngle, 1.0).drag - map.at(kRightAngle - 1e-4, 1.0).drag) / 1e-4,
              0.0, 1e-3);
  // A map that ends before these angles keeps its slope up to its ends.
  const ForceMap part({{0.3, 1.0, 0.2, 0.0}, {0.5, 1.0, 0.4, 0.0}});
  EXPECT_NEAR(part.at(0.4, 1.0).drag, 0.3, 1e-12);
  EXPECT_NEAR(part.at(0.35, 1.0).drag, 0.25, 1e-12);
}

TEST(ForceMap, IsSmoothAndNeverLeavesTheRangeOfItsNeighbours) {
  const ForceMap map({{0.0, 0.0, 0.1, 0.0},
                      {0.3, 0.0, 0.1, 0.8},
                      {0.4, 0.0, 0.9, -0.4},
                      {1.2, 0.0, 0.95, 0.0},
                      {kRightAngle, 0.0, 0.2, 0.0}});
  const double step = 1e-5;
  double last = map.at(0.0, 0.0).drag;
  double last_slope = 0.0;
  for (double angle = step; angle < kRightAngle; angle += step) {
    const double drag = map.at(angle, 0.0).drag;
    ASSERT_GE(drag, 0.1 - 1e-12);
    ASSERT_LE(drag, 0.95 + 1e-12);
    const double slope = (drag - last) / step;
    ASSERT_LT(std::abs(slope - last_slope), 0.05) << "no kink at " << angle;
    last = drag;
    last_slope = slope;
    const double lift = map.at(angle, 0.0).lift;
    ASSERT_LE(lift, 0.8 + 1e-12);
    ASSERT_GE(lift, -0.4 - 1e-12);
  }
}

TEST(ForceMap, ANumberThatIsNoneComesOutAsNone) {
  const ForceMap map = two_speeds();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(map.at(nan, 1.0).drag));
  EXPECT_TRUE(std::isnan(map.at(0.5, nan).lift));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(map.at(infinity, infinity).drag, 1.4);
  EXPECT_EQ(map.at(-infinity, -infinity).drag, 0.2);
}

TEST(ForceMap, OneSpeedServesAll) {
  const ForceMap map({{0.0, 1.0, 0.3, 0.0}, {1.0, 1.0, 0.9, 0.0}});
  EXPECT_EQ(map.at(1.0, 0.1).drag, 0.9);
  EXPECT_EQ(map.at(1.0, 10.0).drag, 0.9);
}

TEST(ForceMap, TakesRowsInAnyOrder) {
  std::vector<ForceMap::Row> rows;
  for (int angle = 0; angle < 5; ++angle) {
    for (int speed = 0; speed < 4; ++speed) {
      rows.push_back({0.3 * angle, 0.5 * speed, 0.1 * angle + 0.05 * speed, 0.0});
    }
  }
  const ForceMap sorted(rows);
  RandomStream random(5, "rows");
  random.shuffle(rows);
  const ForceMap shuffled(rows);
  for (double angle = 0.0; angle < 1.3; angle += 0.01) {
    ASSERT_EQ(sorted.at(angle, 0.77).drag, shuffled.at(angle, 0.77).drag);
  }
}

std::string reason(const std::vector<ForceMap::Row>& rows) {
  try {
    const ForceMap map(rows);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ForceMap, SaysWhichRowIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(reason({{0.0, 0.0, 0.3, 0.0, 2}, {0.5, 0.0, -0.1, 0.0, 3}}),
            "line 3: drag_coefficient: expected a number >= 0 and <= 100, found -0.1");
  EXPECT_NE(reason({{0.0, 0.0, 0.3, nan, 2}, {0.5, 0.0, 0.1, 0.0, 3}}).find("line 2: lift"),
            std::string::npos);
  EXPECT_NE(reason({{0.0, 0.0, 0.3, 0.0, 2}, {45.0, 0.0, 0.1, 0.0, 3}}).find("line 3: angle"),
            std::string::npos)
      << "degrees are not radians";
  EXPECT_NE(reason({{0.0, -1.0, 0.3, 0.0, 2}, {0.5, 0.0, 0.1, 0.0, 3}}).find("line 2: speed"),
            std::string::npos);
}

TEST(ForceMap, WantsEveryAngleWithEverySpeedOnce) {
  EXPECT_NE(reason({}), "");
  EXPECT_NE(reason({{0.1, 0.0, 0.3, 0.0}}), "") << "one angle is no curve";
  EXPECT_NE(reason({{0.0, 0.0, 0.3, 0.0, 2}, {0.5, 0.0, 0.3, 0.0, 3}, {0.5, 0.0, 0.3, 0.0, 4}}),
            "");
  EXPECT_NE(reason({{0.0, 0.0, 0.3, 0.0, 2}, {0.5, 0.0, 0.3, 0.0, 3}, {0.5, 1.0, 0.3, 0.0, 4}}),
            "");
  EXPECT_NE(reason({{0.0, 0.0, 0.3, 0.0, 2}, {0.5, 0.0, 0.3, 0.0, 3}, {0.0, 1.0, 0.3, 0.0, 4}}),
            "");
}

TEST(ForceMap, WantsAnglesApart) {
  EXPECT_NE(reason({{0.0, 0.0, 0.3, 0.0}, {1e-320, 0.0, 0.9, 0.0}, {1.5, 0.0, 0.9, 0.0}}), "");
}

TEST(ForceMap, WantsNoLiftWhereItHasNoSideToPointTo) {
  EXPECT_NE(reason({{0.0, 0.0, 0.3, 0.1, 2}, {kRightAngle, 0.0, 0.3, 0.0, 3}}), "");
  EXPECT_NE(reason({{0.0, 0.0, 0.3, 0.0}, {0.7, 0.0, 0.3, 0.2}, {1.2, 0.0, 0.3, 0.0}}), "");
  EXPECT_EQ(reason({{0.0, 0.0, 0.3, 0.0}, {0.7, 0.0, 0.3, 0.2}, {1.571, 0.0, 0.3, 0.0}}), "");
}

TEST(ForceMap, IsSafeToAskOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  const ForceMap map = two_speeds();
  const test_support::AllocationCounter counter;
  double sum = 0.0;
  for (double angle = -1.0; angle < 2.0; angle += 0.1) sum += map.at(angle, angle).drag;
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_GT(sum, 0.0);
}

}  // namespace force_map_test
}  // namespace jnd::core
