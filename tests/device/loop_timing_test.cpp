#include "device/loop_timing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "core/random_stream.h"
#include "support/allocation_counter.h"

namespace jnd::device {
namespace loop_timing_test {

TEST(DurationHistogram, HasNothingToSayBeforeTheFirstDuration) {
  const DurationHistogram histogram;
  EXPECT_EQ(histogram.percentile_ns(0.5), 0);
  EXPECT_EQ(histogram.max_ns(), 0);
}

TEST(DurationHistogram, IsExactForTheSmallest) {
  DurationHistogram histogram;
  for (std::int64_t ns = 1; ns <= 10; ++ns) histogram.record(ns);
  EXPECT_EQ(histogram.percentile_ns(0.5), 5);
  EXPECT_EQ(histogram.percentile_ns(0.0), 1);
  EXPECT_EQ(histogram.percentile_ns(1.0), 10);
}

TEST(DurationHistogram, KnowsAPercentileToASixteenthAndNeverTooLow) {
  DurationHistogram histogram;
  core::RandomStream random(2, "durations");
  std::vector<std::int64_t> all;
  for (int i = 0; i < 20'000; ++i) {
    all.push_back(static_cast<std::int64_t>(std::pow(10.0, random.uniform(0.0, 9.5))));
    histogram.record(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double ratio : {0.01, 0.1, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(ratio * 20'000.0)) - 1;
    const auto exact = static_cast<double>(all[rank]);
    const auto found = static_cast<double>(histogram.percentile_ns(ratio));
    EXPECT_GE(found, exact) << ratio;
    EXPECT_LE(found, exact * (1.0 + 1.0 / 16.0) + 1.0) << ratio;
  }
  EXPECT_EQ(histogram.max_ns(), all.back());
}

TEST(DurationHistogram, TakesWhatIsNegativeOrBeyondItsRange) {
  DurationHistogram histogram;
  histogram.record(-5);
  EXPECT_EQ(histogram.percentile_ns(1.0), 0);
  histogram.record(std::numeric_limits<std::int64_t>::max());
  histogram.record(100'000'000'000);
  EXPECT_EQ(histogram.count(), 3U);
  EXPECT_EQ(histogram.max_ns(), std::numeric_limits<std::int64_t>::max());
}

TEST(LoopTiming, CountsTicksAndMissedTicksApart) {
  LoopTiming timing;
  timing.record_tick(1'000, 200);
  timing.record_tick(3'000, 300);
  timing.record_missed(2);
  EXPECT_EQ(timing.num_ticks(), 2);
  EXPECT_EQ(timing.missed_ticks(), 2);
  EXPECT_EQ(timing.lateness().max_ns(), 3'000);
  EXPECT_EQ(timing.tick_cost().max_ns(), 300);
}

TEST(LoopTimingSummary, HoldsEveryDurationInItsBucket) {
  LoopTiming timing;
  timing.record_tick(3, 200);
  timing.record_tick(3, 200);
  timing.record_tick(1'000, 300);
  timing.record_missed(2);
  const LoopTimingSummary summary = summary_of(timing);
  EXPECT_EQ(summary.num_ticks, 3);
  EXPECT_EQ(summary.missed_ticks, 2);
  ASSERT_EQ(summary.lateness.buckets.size(), 2U);
  EXPECT_EQ(summary.lateness.buckets[0].end_ns, 3);
  EXPECT_EQ(summary.lateness.buckets[0].count, 2U);
  // 1000 lies in [992, 1024), because the range from 512 to 1024 has 16 classes of 32.
  EXPECT_EQ(summary.lateness.buckets[1].end_ns, 1023);
  EXPECT_EQ(summary.lateness.buckets[1].count, 1U);
  EXPECT_EQ(summary.lateness.max_ns, 1'000);
  EXPECT_EQ(summary.tick_cost.max_ns, 300);
  EXPECT_EQ(summary.tick_cost.buckets.size(), 2U);
}

TEST(LoopTimingSummary, IsEmptyBeforeTheFirstTick) {
  const LoopTimingSummary summary = summary_of(LoopTiming{});
  EXPECT_EQ(summary.num_ticks, 0);
  EXPECT_TRUE(summary.lateness.buckets.empty());
  EXPECT_EQ(summary.lateness.max_ns, 0);
}

TEST(LoopTimingSummary, CanBeTakenWhileTheLoopRuns) {
  LoopTiming timing;
  constexpr std::int64_t kNumTicks = 200'000;
  std::thread loop([&timing] {
    for (std::int64_t i = 0; i < kNumTicks; ++i) timing.record_tick(i, i / 2);
  });
  std::int64_t last = 0;
  while (last < kNumTicks) {
    const LoopTimingSummary summary = summary_of(timing);
    ASSERT_GE(summary.num_ticks, last);
    last = summary.num_ticks;
    std::int64_t sum = 0;
    for (const DurationSummary::Bucket& bucket : summary.lateness.buckets) {
      ASSERT_GT(bucket.count, 0U);
      sum += static_cast<std::int64_t>(bucket.count);
    }
    ASSERT_EQ(sum, summary.num_ticks);
  }
  loop.join();
  EXPECT_EQ(summary_of(timing).lateness.max_ns, kNumTicks - 1);
}

TEST(LoopTiming, IsSafeToUseOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  LoopTiming timing;
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 1000; ++i) timing.record_tick(1000 * i, 10 * i);
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace loop_timing_test
}  // namespace jnd::device
