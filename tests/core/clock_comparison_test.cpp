#include "core/clock_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "core/random_stream.h"

namespace jnd::core {
namespace clock_comparison_test {

/// Feeds pairs from a device whose clock is faster by `ppm`. Its measurements arrive late by
/// 0.2 ms, and half of the time by an additional exponential delay.
void feed(ClockComparison& clocks, double seconds, double ppm, double delay_s,
          std::int64_t device_begins_ns, RandomStream& random, double from_s = 0.0) {
  constexpr double kPeriodS = 0.001;
  for (int i = 0; i * kPeriodS < seconds; ++i) {
    const double time_s = from_s + i * kPeriodS;
    const double late_s =
        0.0002 + (random.with_probability(0.5) ? -delay_s * std::log(random.uniform()) : 0.0);
    clocks.observe(
        5'000'000'000 + static_cast<std::int64_t>(1e9 * (time_s + late_s)),
        device_begins_ns + static_cast<std::int64_t>(1e9 * time_s * (1.0 + 1e-6 * ppm)));
  }
}

TEST(ClockComparison, FindsADriftThroughDelays) {
  for (const double ppm : {-120.0, -3.0, 0.0, 25.0, 400.0}) {
    ClockComparison clocks;
    RandomStream random(7, "clocks", {static_cast<std::int64_t>(ppm)});
    feed(clocks, 60.0, ppm, 0.002, 77, random);
    ASSERT_TRUE(clocks.drift().has_value());
    EXPECT_NEAR(clocks.drift()->drift_ppm, ppm, 0.5) << "delays of 2 ms are no drift";
    EXPECT_LT(clocks.drift()->residual_s, 5e-5);
    EXPECT_NEAR(clocks.drift()->observed_s, 59.0, 1.0);
  }
}

TEST(ClockComparison, SaysNothingBeforeTenSeconds) {
  ClockComparison clocks;
  EXPECT_FALSE(clocks.drift().has_value());
  RandomStream random(7, "clocks");
  feed(clocks, 9.5, 10.0, 0.0, 0, random);
  EXPECT_FALSE(clocks.drift().has_value());
}

TEST(ClockComparison, AClockThatIsSetBeginsAnew) {
  ClockComparison clocks;
  RandomStream random(7, "clocks");
  feed(clocks, 30.0, 10.0, 0.0, 0, random);
  feed(clocks, 30.0, -50.0, 0.0, -90'000'000'000, random, 30.0);
  ASSERT_TRUE(clocks.drift().has_value());
  EXPECT_NEAR(clocks.drift()->drift_ppm, -50.0, 0.5);
  EXPECT_LT(clocks.drift()->observed_s, 31.0);
}

TEST(ClockComparison, TimesAtTheEndsOfTheirRangeDoNoHarm) {
  ClockComparison clocks;
  for (const std::int64_t device_ns : {INT64_MAX, INT64_MIN, INT64_C(0), INT64_MAX - 1}) {
    for (const std::int64_t ours_ns : {INT64_C(1), INT64_MAX, INT64_MIN, INT64_C(7)}) {
      clocks.observe(ours_ns, device_ns);
    }
  }
  const auto drift = clocks.drift();
  EXPECT_TRUE(!drift || std::isfinite(drift->drift_ppm));
}

}  // namespace clock_comparison_test
}  // namespace jnd::core
