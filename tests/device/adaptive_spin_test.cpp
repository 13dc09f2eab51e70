#include "device/adaptive_spin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random_stream.h"

namespace jnd::device {
namespace adaptive_spin_test {

constexpr std::int64_t kPeriodNs = 1'000'000;

/// Wakes up with latencies drawn by `draw_ns`. Returns the ratio of those that came too late in
/// the second half.
template <typename Draw>
double late_ratio(AdaptiveSpin& spin, int num_ticks, Draw&& draw_ns) {
  int late = 0;
  for (int tick = 0; tick < num_ticks; ++tick) {
    const std::int64_t latency_ns = draw_ns();
    if (tick >= num_ticks / 2 && latency_ns > spin.length_ns()) ++late;
    spin.woke_up_late_by(latency_ns);
  }
  return 2.0 * late / num_ticks;
}

TEST(AdaptiveSpin, BeginsAtTheLongestAndEndsAtWhatAPunctualMachineNeeds) {
  AdaptiveSpin spin(200'000, kPeriodNs);
  EXPECT_EQ(spin.length_ns(), 200'000);
  EXPECT_EQ(late_ratio(spin, 100'000, [] { return std::int64_t{20'000}; }), 0.0);
  EXPECT_LT(spin.length_ns(), 50'000);
}

TEST(AdaptiveSpin, LetsOneWakeUpInTwoThousandComeTooLate) {
  AdaptiveSpin spin(400'000, kPeriodNs);
  core::RandomStream random(3, "wake-ups");
  // The latency is exponential with a mean of 20 us, so a ratio of 1/2000 is beyond 152 us.
  const double ratio = late_ratio(spin, 2'000'000, [&random] {
    return static_cast<std::int64_t>(-20'000.0 * std::log(1.0 - random.uniform(0.0, 1.0)));
  });
  EXPECT_LT(ratio, 1.2 / 2000.0);
  EXPECT_GT(ratio, 0.2 / 2000.0);
}

TEST(AdaptiveSpin, OneLongStallDoesNotMakeItSpinForEver) {
  AdaptiveSpin spin(200'000, kPeriodNs);
  late_ratio(spin, 100'000, [] { return std::int64_t{20'000}; });
  const std::int64_t before_ns = spin.length_ns();
  spin.woke_up_late_by(50'000'000);
  EXPECT_LE(spin.length_ns(), before_ns + 20'000);
}

TEST(AdaptiveSpin, NeverTakesMoreThanItsMostNorThanHalfOfThePeriod) {
  AdaptiveSpin wide(200'000, kPeriodNs);
  AdaptiveSpin narrow(200'000, 50'000);
  AdaptiveSpin none(0, kPeriodNs);
  for (int tick = 0; tick < 100; ++tick) {
    for (AdaptiveSpin* spin : {&wide, &narrow, &none}) spin->woke_up_late_by(5'000'000);
  }
  EXPECT_EQ(wide.length_ns(), 200'000);
  EXPECT_EQ(narrow.length_ns(), 25'000);
  EXPECT_EQ(none.length_ns(), 0);
}

}  // namespace adaptive_spin_test
}  // namespace jnd::device
