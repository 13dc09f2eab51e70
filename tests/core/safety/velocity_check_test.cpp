#include "core/safety/velocity_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"

namespace jnd::core {
namespace velocity_check_test {

constexpr double kPeriod_s = 0.001;
constexpr std::array<bool, kNumContactPoints> kAll = {true, true, true, true, true};

PointVectors along_y(double value) {
  PointVectors all = zero_vectors();
  for (Eigen::Vector3d& vector : all) vector.y() = value;
  return all;
}

/// Returns the tick at which the check contradicts within two seconds of strokes of 0.2 m at 2
/// Hz, or -1 if it does not.
int contradicted_at(const std::function<double(double t_s)>& reported_m_per_s,
                    const std::array<bool, kNumContactPoints>& attached = kAll) {
  VelocityCheck check({});
  for (int i = 0; i < 2000; ++i) {
    const double t_s = kPeriod_s * i;
    check.observe(along_y(0.1 * std::sin(4.0 * std::numbers::pi * t_s)),
                  along_y(reported_m_per_s(t_s)), attached, kPeriod_s);
    if (check.is_contradicted()) return i;
  }
  return -1;
}

double truly_m_per_s(double t_s) {
  return 0.1 * 4.0 * std::numbers::pi * std::cos(4.0 * std::numbers::pi * t_s);
}

TEST(VelocityCheck, LeavesTheTruthAlone) { EXPECT_EQ(contradicted_at(truly_m_per_s), -1); }

TEST(VelocityCheck, LeavesAFilterAlone) {
  EXPECT_EQ(contradicted_at([](double t_s) { return truly_m_per_s(t_s - 0.009); }), -1)
      << "9 ms late";
}

TEST(VelocityCheck, FindsAWrongSignWithinCentimetres) {
  const int tick = contradicted_at([](double t_s) { return -truly_m_per_s(t_s); });
  EXPECT_GT(tick, 0);
  EXPECT_LT(tick, 15) << "at 1.26 m/s";
}

TEST(VelocityCheck, FindsAWrongUnitAndOneThatStandsStill) {
  EXPECT_GT(contradicted_at([](double t_s) { return 10.0 * truly_m_per_s(t_s); }), 0);
  EXPECT_GT(contradicted_at([](double) { return 0.0; }), 0);
  EXPECT_GT(contradicted_at([](double) { return 1.0; }), 0);
}

TEST(VelocityCheck, APointThatIsNotHeldMayReportAnything) {
  EXPECT_EQ(contradicted_at([](double t_s) { return -truly_m_per_s(t_s); }, {}), -1);
}

TEST(VelocityCheck, APointThatIsPutBackElsewhereIsNoContradiction) {
  constexpr std::array<bool, kNumContactPoints> kNone = {};
  VelocityCheck check({});
  check.observe(along_y(0.0), along_y(0.0), kAll, kPeriod_s);
  check.observe(along_y(0.0), along_y(0.0), kNone, kPeriod_s);
  check.observe(along_y(0.3), along_y(0.0), kAll, kPeriod_s);
  check.observe(along_y(0.3), along_y(0.0), kAll, kPeriod_s);
  EXPECT_FALSE(check.is_contradicted());
}

TEST(VelocityCheck, NoiseOfAHandAtRestIsNoContradiction) {
  VelocityCheck check({});
  for (int i = 0; i < 10'000; ++i) {
    const double step_m = i % 2 == 0 ? 1e-4 : 0.0;
    check.observe(along_y(step_m), along_y(i % 3 == 0 ? 0.1 : -0.05), kAll, kPeriod_s);
  }
  EXPECT_FALSE(check.is_contradicted());
}

TEST(VelocityCheck, ParametersOutOfRangeAreRefused) {
  EXPECT_THROW(VelocityCheck({.max_error_m = 0.0}), Error);
  EXPECT_THROW(VelocityCheck({.max_error_ratio = -1.0}), Error);
  EXPECT_THROW(VelocityCheck({.memory_s = 0.0}), Error);
}

}  // namespace velocity_check_test
}  // namespace jnd::core
