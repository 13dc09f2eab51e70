#include "device/pointer_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::device {
namespace pointer_guide_test {

constexpr double kPeriodS = 0.001;

/// A guide, and a pointer that reports its place from time to time.
struct Scene {
  explicit Scene(const PointerGuide::Parameters& parameters = {})
      : guide(parameters, kPeriodS) {}

  void point(double x_m, double y_m = 0.0) {
    pointer = {.sequence = pointer.sequence + 1, .x_m = x_m, .y_m = y_m};
  }
  void run(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      const Eigen::Vector2d before_m = guide.position_m();
      const Eigen::Vector2d before_m_per_s = guide.velocity_m_per_s();
      guide.advance(pointer);
      farthest_step_m = std::max(farthest_step_m, (guide.position_m() - before_m).norm());
      hardest_kick_m_per_s =
          std::max(hardest_kick_m_per_s, (guide.velocity_m_per_s() - before_m_per_s).norm());
    }
  }
  [[nodiscard]] double x_m() const { return guide.position_m().x(); }
  [[nodiscard]] double speed_m_per_s() const { return guide.velocity_m_per_s().norm(); }

  PointerGuide guide;
  core::PointerPosition pointer;
  double farthest_step_m = 0.0, hardest_kick_m_per_s = 0.0;
};

TEST(PointerGuide, IsAtRestInTheMiddleUntilAPointerShowsUp) {
  Scene scene;
  scene.run(1000);
  EXPECT_EQ(scene.guide.position_m(), Eigen::Vector2d::Zero());
  EXPECT_EQ(scene.guide.velocity_m_per_s(), Eigen::Vector2d::Zero());
}

TEST(PointerGuide, ComesToRestAtThePointer) {
  Scene scene;
  scene.point(0.2, -0.1);
  scene.run(400);
  EXPECT_NEAR(scene.guide.position_m().x(), 0.2, 1e-9);
  EXPECT_NEAR(scene.guide.position_m().y(), -0.1, 1e-9);
  EXPECT_NEAR(scene.speed_m_per_s(), 0.0, 1e-6);
}

TEST(PointerGuide, NeverOvershoots) {
  Scene scene;
  scene.point(0.3);
  double last_m = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    scene.run(1);
    EXPECT_GE(scene.x_m(), last_m);
    EXPECT_LE(scene.x_m(), 0.3 + 1e-15);
    last_m = scene.x_m();
  }
}

TEST(PointerGuide, StepsAtSixtyHertzLeaveNoRipple) {
  Scene scene;
  double slowest_m_per_s = 1.0, fastest_m_per_s = 0.0, lag_m = 0.0;
  for (int tick = 0; tick < 1500; ++tick) {
    // A monitor's frames take 16, 17 and 17 ms.
    if (tick % 50 == 0 || tick % 50 == 16 || tick % 50 == 33) {
      scene.point(-0.4 + 0.5e-3 * tick);
    }
    scene.run(1);
    if (tick < 500) continue;
    slowest_m_per_s = std::min(slowest_m_per_s, scene.speed_m_per_s());
    fastest_m_per_s = std::max(fastest_m_per_s, scene.speed_m_per_s());
    lag_m = std::max(lag_m, -0.4 + 0.5e-3 * tick - scene.x_m());
  }
  EXPECT_GT(slowest_m_per_s, 0.95 * 0.5);
  EXPECT_LT(fastest_m_per_s, 1.05 * 0.5);
  EXPECT_LT(lag_m, 0.5 * 0.035) << "35 ms behind at most";
}

TEST(PointerGuide, GetsUsedToAWindowThatTellsOfThePointerMoreRarely) {
  Scene scene;
  double slowest_m_per_s = 1.0, fastest_m_per_s = 0.0;
  for (int tick = 0; tick < 1500; ++tick) {
    if (tick % 33 == 0) scene.point(-0.4 + 0.5e-3 * tick);
    scene.run(1);
    if (tick < 750) continue;
    slowest_m_per_s = std::min(slowest_m_per_s, scene.speed_m_per_s());
    fastest_m_per_s = std::max(fastest_m_per_s, scene.speed_m_per_s());
  }
  EXPECT_GT(slowest_m_per_s, 0.95 * 0.5);
  EXPECT_LT(fastest_m_per_s, 1.05 * 0.5);
}

TEST(PointerGuide, NeitherPositionNorVelocityJumpsHoweverWildThePointer) {
  Scene scene;
  core::RandomStream random(1, "pointer");
  for (int i = 0; i < 2000; ++i) {
    scene.point(random.normal(), random.normal());
    scene.run(1 + static_cast<int>(40.0 * random.uniform()));
    EXPECT_LE(scene.speed_m_per_s(), 2.5);
  }
  EXPECT_LE(scene.farthest_step_m, 2.5e-3);
  // The hardest case for the filter is a turn at full speed: 2 * 2.5 m/s * 150 / s / e in one
  // tick.
  EXPECT_LE(scene.hardest_kick_m_per_s, 0.28);
}

TEST(PointerGuide, APointerThatIsNoNumberCountsForNothing) {
  Scene scene;
  scene.point(0.1);
  scene.run(300);
  scene.point(std::numeric_limits<double>::quiet_NaN());
  scene.run(300);
  scene.point(0.2, std::numeric_limits<double>::infinity());
  scene.run(300);
  EXPECT_NEAR(scene.x_m(), 0.1, 1e-9);
  scene.point(0.2);
  scene.run(300);
  EXPECT_NEAR(scene.x_m(), 0.2, 1e-9) << "and the next one counts again";
}

TEST(PointerGuide, APointerOutOfReachIsHeldAtItsEdge) {
  Scene scene({.reach_m = 0.4});
  scene.point(1e9, -1e300);
  scene.run(1000);
  EXPECT_NEAR(scene.guide.position_m().x(), 0.4, 1e-9);
  EXPECT_NEAR(scene.guide.position_m().y(), -0.4, 1e-9);
}

TEST(PointerGuide, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(PointerGuide({.bandwidth_rad_per_s = 0.0}, kPeriodS), core::Error);
  EXPECT_THROW(PointerGuide({.max_speed_m_per_s = nan}, kPeriodS), core::Error);
  EXPECT_THROW(PointerGuide({.reach_m = -1.0}, kPeriodS), core::Error);
  EXPECT_THROW(PointerGuide({}, 0.0), core::Error);
}

}  // namespace pointer_guide_test
}  // namespace jnd::device
