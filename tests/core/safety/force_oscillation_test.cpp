#include "core/safety/force_oscillation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace jnd::core {
namespace force_oscillation_test {

constexpr double kPeriod_s = 0.001;

/// Returns whether a force of this amplitude and frequency is found within three seconds.
bool is_found(double amplitude_n, double frequency_hz, double offset_n = 0.0, int axis = 0) {
  ForceOscillation oscillation({}, kPeriod_s);
  for (int i = 0; i < 3000 && !oscillation.is_found(); ++i) {
    Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
    force_n[axis] = offset_n + amplitude_n * std::sin(2.0 * std::numbers::pi * frequency_hz *
                                                      kPeriod_s * i);
    oscillation.observe(force_n);
  }
  return oscillation.is_found();
}

TEST(ForceOscillation, FindsWhatIsFasterThanAnyHand) {
  for (const double frequency_hz : {22.0, 30.0, 60.0, 120.0, 250.0}) {
    for (const int axis : {0, 1, 2}) {
      EXPECT_TRUE(is_found(1.2, frequency_hz, 0.0, axis)) << frequency_hz;
      EXPECT_TRUE(is_found(15.0, frequency_hz, 0.0, axis)) << frequency_hz;
    }
  }
}

TEST(ForceOscillation, FindsItOnTopOfAForceThatKeepsItsSign) {
  EXPECT_TRUE(is_found(2.0, 50.0, 5.0)) << "chatter on a surface";
}

TEST(ForceOscillation, LeavesStrokesAndTremorAlone) {
  for (const double frequency_hz : {0.5, 2.0, 6.0, 12.0, 18.0}) {
    EXPECT_FALSE(is_found(15.0, frequency_hz)) << frequency_hz;
  }
}

TEST(ForceOscillation, LeavesNoiseAlone) {
  EXPECT_FALSE(is_found(0.9, 100.0)) << "less than two newtons from end to end";
}

TEST(ForceOscillation, ForgetsWhatIsLongAgo) {
  ForceOscillation oscillation({}, kPeriod_s);
  for (int knock = 0; knock < 40; ++knock) {
    for (int i = 0; i < 200; ++i) oscillation.observe({i < 100 ? 5.0 : 0.0, 0.0, 0.0});
  }
  EXPECT_FALSE(oscillation.is_found()) << "ten turns a second";
}

TEST(ForceOscillation, AResetForgetsAll) {
  ForceOscillation oscillation({}, kPeriod_s);
  for (int i = 0; i < 100; ++i) oscillation.observe({i % 2 == 0 ? 5.0 : 0.0, 0.0, 0.0});
  EXPECT_TRUE(oscillation.is_found());
  oscillation.reset();
  EXPECT_FALSE(oscillation.is_found());
  oscillation.observe({5.0, 0.0, 0.0});
  oscillation.observe({0.0, 0.0, 0.0});
  EXPECT_FALSE(oscillation.is_found());
}

TEST(ForceOscillation, ParametersOutOfRangeAreRefused) {
  EXPECT_THROW(ForceOscillation({.swing_n = 0.0}, kPeriod_s), Error);
  EXPECT_THROW(ForceOscillation({.window_s = 0.0}, kPeriod_s), Error);
  EXPECT_THROW(ForceOscillation({.max_turns = 1}, kPeriod_s), Error);
  EXPECT_THROW(ForceOscillation({.max_turns = 33}, kPeriod_s), Error);
}

}  // namespace force_oscillation_test
}  // namespace jnd::core
