#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace jnd::device {

/// A histogram as it is stored.
struct DurationSummary {
  struct Bucket {
    std::int64_t end_ns = 0;  ///< Its longest duration; the last there can be holds longer too.
    std::uint64_t count = 0;  ///< > 0: empty buckets are left out.
  };
  std::vector<Bucket> buckets;  ///< Ascending.
  std::int64_t max_ns = 0;      ///< Of all, exact; 0 if there were none.
};

/// Durations in fixed buckets: each power of two in 16 equal parts, so that a percentile is
/// known to 1/16 of its value, from 1 ns to 17 s. One thread records; any thread may read at
/// any time. Real time, no heap.
class DurationHistogram {
 public:
  /// Less than zero counts as zero.
  void record(std::int64_t duration_ns) noexcept;

  /// The smallest duration that at least `ratio` of all were not longer than, rounded up to its
  /// bucket's end and never above `max_ns`. 0 if nothing was recorded. `ratio` in [0, 1].
  [[nodiscard]] std::int64_t percentile_ns(double ratio) const noexcept;
  [[nodiscard]] std::int64_t max_ns() const noexcept {
    return max_ns_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t count() const noexcept {
    return count_.load(std::memory_order_relaxed);
  }
  /// As it is now; each bucket is one moment's, whatever is recorded meanwhile. Not real time.
  [[nodiscard]] DurationSummary summary() const;

 private:
  static constexpr int kNumBuckets = 16 * 32;

  [[nodiscard]] static int bucket_of(std::int64_t duration_ns) noexcept;
  [[nodiscard]] static std::int64_t bucket_end_ns(int bucket) noexcept;

  std::array<std::atomic<std::uint64_t>, kNumBuckets> buckets_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> max_ns_{0};
};

/// How punctual a real-time loop is. Written by the loop's thread, read by any.
class LoopTiming {
 public:
  /// From when the tick was due until its force was written, and how long the whole tick took.
  void record_tick(std::int64_t lateness_ns, std::int64_t tick_cost_ns) noexcept {
    lateness_.record(lateness_ns);
    tick_cost_.record(tick_cost_ns);
  }
  /// Ticks that were due but never run, because the one before them took too long.
  void record_missed(std::int64_t num_ticks) noexcept {
    missed_ticks_.fetch_add(num_ticks, std::memory_order_relaxed);
  }

  [[nodiscard]] const DurationHistogram& lateness() const noexcept { return lateness_; }
  [[nodiscard]] const DurationHistogram& tick_cost() const noexcept { return tick_cost_; }
  [[nodiscard]] std::int64_t num_ticks() const noexcept {
    return static_cast<std::int64_t>(lateness_.count());
  }
  [[nodiscard]] std::int64_t missed_ticks() const noexcept {
    return missed_ticks_.load(std::memory_order_relaxed);
  }

 private:
  DurationHistogram lateness_;
  DurationHistogram tick_cost_;
  std::atomic<std::int64_t> missed_ticks_{0};
};

/// How punctual a loop was, for keeping.
struct LoopTimingSummary {
  std::int64_t num_ticks = 0;  ///< Exactly those in `lateness`.
  std::int64_t missed_ticks = 0;
  DurationSummary lateness;   ///< From when a tick was due until its force was written.
  DurationSummary tick_cost;  ///< Of whole ticks; of a running loop it may be one tick apart.
};

/// Up to now, also while the loop runs. Any thread. Not real time.
[[nodiscard]] LoopTimingSummary summary_of(const LoopTiming& timing);

}  // namespace jnd::device
