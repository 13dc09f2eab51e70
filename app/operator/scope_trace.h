#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/sample.h"

namespace jnd::app {

/// What a channel did in one short interval: nothing between its samples is lost.
struct ScopePoint {
  double time_s = 0.0;            ///< Of the interval's first tick: ticks over the loop's rate.
  float low = 0.0f, high = 0.0f;  ///< NaN where no sample of it was finite.
};

/// The last seconds of some channels, all at the same times.
struct ScopePicture {
  double newest_s = 0.0;     ///< Of the newest interval.
  double interval_s = 0.01;  ///< How long each one is; more between two is a gap.
  std::vector<std::vector<ScopePoint>> channels;  ///< As asked for; empty for an unknown name.
  bool has_joints = false;                        ///< Some sample had any.
};

/// The last seconds of every number of the samples, for scopes: every sample goes in, about a
/// hundred intervals a second are kept with the least and the largest of each channel, so no
/// spike is lost and the memory is fixed (below 1 MB). Lost samples leave a gap in time;
/// samples of an earlier time begin it anew.
///
/// Samples come from one thread; a picture may be taken from any. Not real time.
class ScopeTrace {
 public:
  struct Parameters {
    double rate_hz = 1000.0;         ///< Of the loop, > 0.
    double duration_s = 10.0;        ///< How much is kept, > 0.
    double intervals_per_s = 100.0;  ///< > 0; at most one a tick.
  };

  /// Throws `core::Error` naming the field.
  explicit ScopeTrace(const Parameters& parameters);

  void take(const core::Sample& sample);
  /// Of the channels with these names (`ScopeChannel::name`), the oldest interval first; the
  /// one under way is not in.
  [[nodiscard]] ScopePicture snapshot(const std::vector<std::string>& names) const;
  void clear();

 private:
  struct Extent {
    float low, high;
  };
  // With the lock held.
  void begin_interval(std::int64_t number);
  void finish_interval();
  void start_anew();
  [[nodiscard]] double time_s_of(std::int64_t interval) const noexcept;

  Parameters parameters_;
  std::vector<std::string> names_;
  std::int64_t ticks_per_interval_ = 1;
  std::size_t capacity_ = 1;

  mutable std::mutex mutex_;
  // A ring: the number of each interval, and beside it a row of all channels.
  std::vector<std::int64_t> intervals_;
  std::vector<Extent> extents_;
  std::size_t next_ = 0, count_ = 0;
  std::vector<Extent> current_;
  bool has_current_ = false;
  std::int64_t current_interval_ = 0;
  bool has_joints_ = false;
};

}  // namespace jnd::app
