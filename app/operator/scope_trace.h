#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/sample.h"

namespace jnd::app {

/// The extent of a channel in a short interval, so that nothing between its samples is lost.
struct ScopePoint {
  /// The time of the interval's first tick: its number over the loop's rate.
  double time_s = 0.0;
  float low = 0.0f, high = 0.0f;  ///< NaN if no sample of the channel was finite.
};

/// The last seconds of some channels, all at the same times.
struct ScopePicture {
  double newest_s = 0.0;  ///< The time of the newest interval.
  /// The length of each interval; a longer time between two of them is a gap.
  double interval_s = 0.01;
  /// In the order in which they were asked for; empty for an unknown name.
  std::vector<std::vector<ScopePoint>> channels;
  bool has_joints = false;  ///< Some sample had joints.
};

/// The last seconds of every number of the samples, for scopes. Every sample goes in; about a
/// hundred intervals a second are kept, with the least and the largest value of each channel.
/// So no spike is lost, and the memory is fixed (below 1 MB). Lost samples leave a gap in time;
/// a sample of an earlier time makes the trace begin anew.
///
/// Samples come from one thread; any thread may take a picture. Not real time.
class ScopeTrace {
 public:
  struct Parameters {
    double rate_hz = 1000.0;         ///< The loop's rate, > 0.
    double duration_s = 10.0;        ///< How much is kept, > 0.
    double intervals_per_s = 100.0;  ///< > 0, and at most one interval for each tick.
  };

  /// Throws `core::Error`, which names the wrong field.
  explicit ScopeTrace(const Parameters& parameters);

  void take(const core::Sample& sample);
  /// The channels with these names (`ScopeChannel::name`), the oldest interval first, without
  /// the interval under way.
  [[nodiscard]] ScopePicture snapshot(const std::vector<std::string>& names) const;
  void clear();

 private:
  struct Extent {
    float low, high;
  };
  // These are called with the lock held.
  void begin_interval(std::int64_t number);
  void finish_interval();
  void start_anew();
  [[nodiscard]] double time_s_of(std::int64_t interval) const noexcept;

  Parameters parameters_;
  std::vector<std::string> names_;
  std::int64_t ticks_per_interval_ = 1;
  std::size_t capacity_ = 1;

  mutable std::mutex mutex_;
  // A ring of the intervals' numbers, and beside it a row of all channels for each.
  std::vector<std::int64_t> intervals_;
  std::vector<Extent> extents_;
  std::size_t next_ = 0, count_ = 0;
  std::vector<Extent> current_;
  bool has_current_ = false;
  std::int64_t current_interval_ = 0;
  bool has_joints_ = false;
};

}  // namespace jnd::app
