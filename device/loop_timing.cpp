#include "device/loop_timing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace jnd::device {
namespace {

/// Only one thread writes, so no locked instruction is needed.
void add_one(std::atomic<std::uint64_t>& counter) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace

int DurationHistogram::bucket_of(std::int64_t duration_ns) noexcept {
  const auto value = static_cast<std::uint64_t>(std::max<std::int64_t>(duration_ns, 0));
  if (value < 16) return static_cast<int>(value);
  const int shift = static_cast<int>(std::bit_width(value)) - 5;
  const int bucket = 16 * (shift + 1) + static_cast<int>((value >> shift) - 16);
  return std::min(bucket, kNumBuckets - 1);
}

std::int64_t DurationHistogram::bucket_end_ns(int bucket) noexcept {
  if (bucket < 16) return bucket;
  const int shift = bucket / 16 - 1;
  const std::int64_t part = bucket % 16 + 16;
  return ((part + 1) << shift) - 1;
}

void DurationHistogram::record(std::int64_t duration_ns) noexcept {
  add_one(buckets_[static_cast<std::size_t>(bucket_of(duration_ns))]);
  add_one(count_);
  if (duration_ns > max_ns_.load(std::memory_order_relaxed)) {
    max_ns_.store(duration_ns, std::memory_order_relaxed);
  }
}

std::int64_t DurationHistogram::percentile_ns(double ratio) const noexcept {
  const std::uint64_t total = count();
  if (total == 0) return 0;
  const auto wanted = std::clamp<std::uint64_t>(
      static_cast<std::uint64_t>(std::ceil(ratio * static_cast<double>(total))), 1, total);
  std::uint64_t seen = 0;
  for (int bucket = 0; bucket < kNumBuckets; ++bucket) {
    seen += buckets_[static_cast<std::size_t>(bucket)].load(std::memory_order_relaxed);
    if (seen >= wanted) return std::min(bucket_end_ns(bucket), max_ns());
  }
  return max_ns();
}

DurationSummary DurationHistogram::summary() const {
  DurationSummary summary;
  for (int bucket = 0; bucket < kNumBuckets; ++bucket) {
    const std::uint64_t count =
        buckets_[static_cast<std::size_t>(bucket)].load(std::memory_order_relaxed);
    if (count > 0) summary.buckets.push_back({bucket_end_ns(bucket), count});
  }
  summary.max_ns = max_ns();
  return summary;
}

LoopTimingSummary summary_of(const LoopTiming& timing) {
  LoopTimingSummary summary{.missed_ticks = timing.missed_ticks(),
                            .lateness = timing.lateness().summary(),
                            .tick_cost = timing.tick_cost().summary()};
  for (const DurationSummary::Bucket& bucket : summary.lateness.buckets) {
    summary.num_ticks += static_cast<std::int64_t>(bucket.count);
  }
  return summary;
}

}  // namespace jnd::device
