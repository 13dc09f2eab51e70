#include "core/safety/stillness_watch.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace jnd::core {
namespace stillness_watch_test {

constexpr double kPeriod_s = 0.001;
constexpr std::array<bool, kNumContactPoints> kAll = {true, true, true, true, true};
constexpr std::uint8_t kIndex = 1 << 3;

PointVectors at(double x_m) {
  PointVectors points = zero_vectors();
  for (Eigen::Vector3d& point : points) point.x() = x_m;
  return points;
}

void stand(StillnessWatch& watch, double duration_s, std::uint8_t pushed_bits,
           double speed_m_per_s = 0.0) {
  for (int i = 0; i < static_cast<int>(duration_s / kPeriod_s); ++i) {
    watch.observe(at(0.1), at(speed_m_per_s), kAll, pushed_bits, kPeriod_s);
  }
}

TEST(StillnessWatch, TakesTheForceAwayBeforeItCallsASensorDead) {
  StillnessWatch watch({}, kPeriod_s);
  stand(watch, 1.99, kIndex);
  EXPECT_EQ(watch.authority_ratio(3), 1.0);
  EXPECT_FALSE(watch.asks_to_move());
  stand(watch, 1.01, kIndex);
  EXPECT_NEAR(watch.authority_ratio(3), 0.5, 0.01) << "a second into fading";
  EXPECT_EQ(watch.authority_ratio(0), 1.0) << "the others keep theirs";
  EXPECT_TRUE(watch.asks_to_move());
  stand(watch, 1.5, kIndex);
  EXPECT_EQ(watch.authority_ratio(3), 0.0);
  EXPECT_FALSE(watch.is_frozen());
  stand(watch, 0.6, kIndex);
  EXPECT_TRUE(watch.is_frozen());
}

TEST(StillnessWatch, AnyChangeBringsTheForceBack) {
  StillnessWatch watch({}, kPeriod_s);
  stand(watch, 4.5, kIndex);
  ASSERT_EQ(watch.authority_ratio(3), 0.0);
  for (int i = 1; i <= 501; ++i) {
    watch.observe(at(0.1 + 1e-7 * i), at(0.0), kAll, kIndex, kPeriod_s);
    EXPECT_NEAR(watch.authority_ratio(3), i / 500.0, 0.003) << "slowly";
    EXPECT_FALSE(watch.asks_to_move());
  }
  EXPECT_EQ(watch.authority_ratio(3), 1.0);
  stand(watch, 1.9, kIndex);
  EXPECT_EQ(watch.authority_ratio(3), 1.0) << "and all begins anew";
}

TEST(StillnessWatch, WhoIsNotPushedMayRest) {
  StillnessWatch watch({}, kPeriod_s);
  stand(watch, 60.0, 0);
  EXPECT_FALSE(watch.is_frozen());
  EXPECT_FALSE(watch.asks_to_move());
}

TEST(StillnessWatch, APointThatIsNotHeldMayRest) {
  StillnessWatch watch({}, kPeriod_s);
  for (int i = 0; i < 10'000; ++i) watch.observe(at(0.1), at(1.0), {}, kIndex, kPeriod_s);
  EXPECT_FALSE(watch.is_frozen());
}

TEST(StillnessWatch, AVelocityWithoutAWayIsFrozenAndNoiseIsNot) {
  StillnessWatch watch({}, kPeriod_s);
  stand(watch, 0.65, 0, 0.02);
  EXPECT_FALSE(watch.is_frozen());
  stand(watch, 0.1, 0, 0.02);
  EXPECT_TRUE(watch.is_frozen()) << "a centimetre at 2 cm/s, some of it forgotten";
  watch.reset();
  stand(watch, 60.0, 0, 0.003);
  EXPECT_FALSE(watch.is_frozen()) << "a bias that coarse sensors have at rest";
  for (int i = 0; i < 60'000; ++i) {
    watch.observe(at(0.1), at(i % 2 == 0 ? 0.04 : -0.04), kAll, 0, kPeriod_s);
  }
  EXPECT_FALSE(watch.is_frozen());
}

TEST(StillnessWatch, MeasurementsThatComeSeldomTakeNoLonger) {
  StillnessWatch watch({}, kPeriod_s);
  const auto stand_seldom = [&watch](int num_ms) {
    for (int ms = 0; ms < num_ms; ms += 10) {
      watch.observe(at(0.1), at(0.0), kAll, kIndex, 10 * kPeriod_s);
    }
  };
  stand_seldom(3010);
  EXPECT_NEAR(watch.authority_ratio(3), 0.5, 0.01);
  stand_seldom(2200);
  EXPECT_TRUE(watch.is_frozen());
  watch.observe(at(0.2), at(0.0), kAll, kIndex, 10 * kPeriod_s);
  EXPECT_NEAR(watch.authority_ratio(3), kPeriod_s / 0.5, 1e-12)
      << "nor does it come back faster";
}

TEST(StillnessWatch, ParametersOutOfRangeAreRefused) {
  EXPECT_THROW(StillnessWatch({.max_still_s = 0.0}, kPeriod_s), Error);
  EXPECT_THROW(StillnessWatch({.fade_s = -1.0}, kPeriod_s), Error);
  EXPECT_THROW(StillnessWatch({.max_way_m = 0.0}, kPeriod_s), Error);
  EXPECT_THROW(StillnessWatch({}, 0.0), Error);
}

}  // namespace stillness_watch_test
}  // namespace jnd::core
