#include "analysis/movement/recorded_strokes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/movement/strokes.h"
#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace recorded_strokes_test {

constexpr double kTickS = 0.001;

/// Moves a hand along x and collects the halves of its strokes.
class Hand {
 public:
  explicit Hand(const HalfStrokeFinder::Parameters& parameters = {}) : finder_(parameters) {}

  void go(double x_m, double speed_m_per_s, double dissipated_w = 0.0, bool sound = true) {
    const auto half = finder_.feed({.tick = tick_++,
                                    .x_m = x_m,
                                    .speed_m_per_s = speed_m_per_s,
                                    .dissipated_w = dissipated_w,
                                    .sound = sound});
    if (half) halves.push_back(*half);
  }
  /// Moves straight for this many ticks. The first place is left out.
  void sweep(double from_m, double to_m, int num_ticks) {
    for (int i = 1; i <= num_ticks; ++i) {
      go(from_m + (to_m - from_m) * i / num_ticks,
         std::abs(to_m - from_m) / (num_ticks * kTickS));
    }
  }

  std::vector<HalfStroke> halves;

 private:
  HalfStrokeFinder finder_;
  std::int64_t tick_ = 0;
};

TEST(HalfStrokeFinder, KnowsTheTicksOfTheTurningPoints) {
  Hand hand;
  hand.go(0.0, 0.0);
  hand.sweep(0.0, 0.2, 100);
  hand.sweep(0.2, -0.2, 400);
  hand.sweep(-0.2, 0.1, 300);
  hand.sweep(0.1, 0.0, 100);
  ASSERT_EQ(hand.halves.size(), 3U);
  EXPECT_FALSE(hand.halves[0].whole);
  EXPECT_TRUE(hand.halves[1].whole);
  EXPECT_EQ(hand.halves[1].first_tick, 100);
  EXPECT_EQ(hand.halves[1].last_tick, 500);
  EXPECT_NEAR(hand.halves[1].width_m, 0.4, 1e-12);
  EXPECT_NEAR(hand.halves[1].path_m, 0.4, 1e-12);
  EXPECT_NEAR(hand.halves[1].max_speed_m_per_s, 1.0, 1e-12);
  EXPECT_EQ(hand.halves[2].last_tick, 800);
  EXPECT_NEAR(hand.halves[2].width_m, 0.3, 1e-12);
}

TEST(HalfStrokeFinder, CountsARestAsAPauseFromItsBeginningAndAShortOneNotAtAll) {
  Hand hand;
  hand.go(0.0, 0.0);
  hand.sweep(0.0, 0.2, 100);
  hand.sweep(0.2, 0.0, 200);
  for (int i = 0; i < 400; ++i) hand.go(0.0, 0.001);
  hand.sweep(0.0, -0.2, 200);
  hand.sweep(-0.2, 0.0, 200);
  for (int i = 0; i < 140; ++i) hand.go(0.0, 0.001);
  hand.sweep(0.0, 0.2, 200);
  hand.sweep(0.2, 0.0, 200);
  ASSERT_EQ(hand.halves.size(), 3U);
  EXPECT_NEAR(hand.halves[1].pause_s, 0.400, 1e-12);
  EXPECT_EQ(hand.halves[1].num_ticks(), 800);
  EXPECT_EQ(hand.halves[2].pause_s, 0.0);
}

TEST(HalfStrokeFinder, ATickThatIsNotSoundSpoilsItsHalfAlone) {
  Hand hand;
  hand.go(0.0, 0.0);
  hand.sweep(0.0, 0.2, 100);
  hand.sweep(0.2, 0.0, 100);
  hand.go(-0.001, 1.0, 0.0, false);
  hand.sweep(-0.001, -0.2, 100);
  hand.sweep(-0.2, 0.2, 100);
  hand.sweep(0.2, 0.0, 100);
  ASSERT_EQ(hand.halves.size(), 3U);
  EXPECT_FALSE(hand.halves[1].sound);
  EXPECT_TRUE(hand.halves[2].sound);
}

TEST(HalfStrokeFinder, ASpeedAndALossRightAfterATurningPointBelongToTheHalfThatBeginsThere) {
  Hand hand;
  hand.go(0.0, 1.0);
  hand.go(0.2, 1.0, 7.0);
  hand.go(0.19, 8.0, 2.0);  // The finder does not know yet that the hand has turned.
  hand.go(-0.2, 1.0, 3.0);
  hand.go(0.0, 1.0, 11.0);
  ASSERT_EQ(hand.halves.size(), 2U);
  EXPECT_EQ(hand.halves[1].max_speed_m_per_s, 8.0);
  EXPECT_NEAR(hand.halves[1].energy_j, 5.0 * kTickS, 1e-15);
}

TEST(HalfStrokeFinder, FindsWhatTheMeterOfTheSessionFound) {
  core::RandomStream random(3, "recorded strokes test");
  StrokeMeter meter({});
  HalfStrokeFinder finder({});
  StrokeSums sums;
  std::vector<HalfStroke> whole;
  for (int tick = 0; tick < 20000; ++tick) {
    const double phase = 2.0 * std::numbers::pi * 0.6 * tick * kTickS + 0.7;
    const double amplitude_m = 0.15 + 0.05 * std::sin(0.3 * tick * kTickS);
    const Eigen::Vector3d position_m(
        0.8 * amplitude_m * std::sin(phase) + random.normal(0, 1e-3),
        0.6 * amplitude_m * std::sin(phase) + random.normal(0, 1e-3), -0.1);
    const Eigen::Vector3d velocity_m_per_s(amplitude_m * std::cos(phase), 0.0, 0.01);
    meter.feed(position_m, velocity_m_per_s, kTickS);
    const auto half = finder.feed({.tick = tick,
                                   .x_m = position_m.x(),
                                   .y_m = position_m.y(),
                                   .z_m = position_m.z(),
                                   .speed_m_per_s = velocity_m_per_s.norm()});
    if (half && half->whole) whole.push_back(*half);
  }
  for (std::size_t i = 1; i < whole.size(); i += 2) sums.add(whole[i - 1], whole[i], kTickS);
  const StrokeSummary expected = meter.finish();
  const StrokeMeans found = sums.means();
  EXPECT_GE(expected.num_strokes, 10);
  EXPECT_EQ(found.num_strokes, expected.num_strokes);
  EXPECT_NEAR(*found.stroke_width_m, *expected.stroke_width_m, 1e-12);
  EXPECT_NEAR(*found.max_speed_m_per_s, *expected.max_speed_m_per_s, 1e-12);
}

TEST(HalfStrokeFinder, TurnsAnywhereTheHandIsTurned) {
  HalfStrokeFinder finder({});
  std::vector<HalfStroke> halves;
  const double direction_rad = 1.1;
  for (int tick = 0; tick < 4000; ++tick) {
    const double way_m = 0.2 * std::sin(2.0 * std::numbers::pi * tick / 1000.0);
    const auto half = finder.feed({.tick = tick,
                                   .x_m = way_m * std::cos(direction_rad),
                                   .y_m = way_m * std::sin(direction_rad),
                                   .speed_m_per_s = 1.0});
    if (half) halves.push_back(*half);
  }
  ASSERT_EQ(halves.size(), 8U);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    EXPECT_EQ(halves[i].last_tick, 250 + 500 * static_cast<std::int64_t>(i));
    EXPECT_NEAR(halves[i].width_m, i == 0 ? 0.2 : 0.4, 1e-12);
  }
}

TEST(StrokeSums, AreMeansOverStrokesThatAddUp) {
  const HalfStroke there{.first_tick = 0,
                         .last_tick = 400,
                         .width_m = 0.2,
                         .max_speed_m_per_s = 0.5,
                         .path_m = 0.3,
                         .energy_j = 1.0};
  const HalfStroke back{.first_tick = 400,
                        .last_tick = 1000,
                        .width_m = 0.4,
                        .max_speed_m_per_s = 0.9,
                        .path_m = 0.4,
                        .pause_s = 0.2,
                        .energy_j = 2.0};
  const HalfStroke slow{.first_tick = 1000,
                        .last_tick = 3000,
                        .width_m = 0.4,
                        .max_speed_m_per_s = 0.1,
                        .path_m = 0.4};
  StrokeSums sums, other;
  sums.add(there, back, kTickS);
  other.add(slow, there, kTickS);
  sums.add(other);
  const StrokeMeans means = sums.means();
  EXPECT_EQ(means.num_strokes, 2);
  EXPECT_NEAR(*means.stroke_width_m, 0.3, 1e-12);
  EXPECT_NEAR(*means.max_speed_m_per_s, 0.5 * (0.9 + 0.5), 1e-12);
  EXPECT_NEAR(*means.mean_speed_m_per_s, 1.4 / 3.4, 1e-12);
  EXPECT_NEAR(*means.stroke_duration_s, 1.7, 1e-12);
  EXPECT_NEAR(*means.pause_s, 0.1, 1e-12);
  EXPECT_NEAR(*means.stroke_energy_j, 2.0, 1e-12);
  EXPECT_FALSE(StrokeSums().means().stroke_width_m.has_value());
}

TEST(HalfStrokeFinder, NamesTheParameterItRejects) {
  EXPECT_THROW(HalfStrokeFinder({.period_s = 0.0}), core::Error);
  EXPECT_THROW(HalfStrokeFinder({.hysteresis_m = std::nan("")}), core::Error);
  EXPECT_THROW(HalfStrokeFinder({.rest_speed_m_per_s = -1.0}), core::Error);
  EXPECT_THROW(HalfStrokeFinder({.shortest_pause_s = HUGE_VAL}), core::Error);
}

}  // namespace recorded_strokes_test
}  // namespace jnd::analysis
