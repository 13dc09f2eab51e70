#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace jnd::device {

/// A histogram as it is stored.
struct DurationSummary {
  struct Bucket {
    /// Longest duration in the bucket. The last possible bucket also holds longer ones.
    std::int64_t end_ns = 0;
    std::uint64_t count = 0;  ///< > 0, because empty buckets are left out.
  };
  std::vector<Bucket> buckets;  ///< Ascending.
  std::int64_t max_ns = 0;      ///< The exact maximum of all durations; 0 if there were none.
};

/// Counts durations in fixed buckets. Each power of two is divided into 16 equal parts, so a
/// percentile is known to 1/16 of its value, from 1 ns to 17 s. One thread records; any thread
/// may read at any time. Real time, no heap.
class DurationHistogram {
 public:
  /// Values below zero count as zero.
  void record(std::int64_t duration_ns) noexcept;

  /// Returns the smallest duration that at least `ratio` of all durations do not exceed,
  /// rounded up to the end of its bucket but at most `max_ns`. Returns 0 if nothing was
  /// recorded. `ratio` is in [0, 1].
  [[nodiscard]] std::int64_t percentile_ns(double ratio) const noexcept;
  [[nodiscard]] std::int64_t max_ns() const noexcept {
    return max_ns_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t count() const noexcept {
    return count_.load(std::memory_order_relaxed);
  }
  /// Returns the present counts. If another thread records meanwhile, the buckets may be of
  /// slightly different moments. Not real time.
  [[nodiscard]] DurationSummary summary() const;

 private:
  static constexpr int kNumBuckets = 16 * 32;

  [[nodiscard]] static int bucket_of(std::int64_t duration_ns) noexcept;
  [[nodiscard]] static std::int64_t bucket_end_ns(int bucket) noexcept;

  std::array<std::atomic<std::uint64_t>, kNumBuckets> buckets_{};
  std::atomic<std::uint64_t> count_{0};
  std::atomic<std::int64_t> max_ns_{0};
};

/// How punctual a real-time loop is. The loop's thread writes it; any thread may read it.
class LoopTiming {
 public:
  /// Records the time from when the tick was due until its force was written, and the duration
  /// of the whole tick.
  void record_tick(std::int64_t lateness_ns, std::int64_t tick_cost_ns) noexcept {
    lateness_.record(lateness_ns);
    tick_cost_.record(tick_cost_ns);
  }
  /// Records ticks that were due but never ran, because an earlier one took too long.
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

/// How punctual a loop was, in a form that is stored.
struct LoopTimingSummary {
  std::int64_t num_ticks = 0;  ///< Exactly the number of ticks in `lateness`.
  std::int64_t missed_ticks = 0;
  DurationSummary lateness;  ///< Time from when a tick was due until its force was written.
  /// Duration of whole ticks. While the loop runs, its count may differ by one tick.
  DurationSummary tick_cost;
};

/// Returns the summary up to now, also while the loop runs. Any thread. Not real time.
[[nodiscard]] LoopTimingSummary summary_of(const LoopTiming& timing);

}  // namespace jnd::device
