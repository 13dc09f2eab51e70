#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/sample.h"

namespace jnd::app {

/// How the hand moved in a short interval, in the workspace frame.
struct TracePoint {
  /// The time of the interval's first tick: its number over the loop's rate.
  double time_s = 0.0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< The mean of the tips at the interval's end.
  /// The largest speed in the interval, of the tips' mean velocity.
  double speed_m_per_s = 0.0;
  double force_n = 0.0;  ///< The largest force on the hand in the interval.
};

/// The last seconds of the hand's movement, for plots. Every sample goes in; about a hundred
/// points a second are kept, without losing any peak of speed or force. Values that are not
/// finite are left out. Lost samples leave a gap in time; a sample of an earlier time makes the
/// trace begin anew.
///
/// Samples come from one thread; any thread may take a picture. Not real time.
class LiveTrace {
 public:
  struct Parameters {
    double rate_hz = 1000.0;      ///< The loop's rate, > 0.
    double duration_s = 10.0;     ///< How much is kept, > 0.
    double points_per_s = 100.0;  ///< > 0, and at most one point for each tick.
  };

  /// Throws `core::Error`, which names the wrong field.
  explicit LiveTrace(const Parameters& parameters);

  void take(const core::Sample& sample);
  /// The points of the last `duration_s`, oldest first, without the interval under way.
  [[nodiscard]] std::vector<TracePoint> snapshot() const;
  void clear();

 private:
  // These are called with the lock held.
  void finish_interval();
  void start_anew();
  [[nodiscard]] const TracePoint& newest() const;

  Parameters parameters_;
  std::int64_t ticks_per_point_ = 1;
  std::size_t capacity_ = 1;

  mutable std::mutex mutex_;
  std::vector<TracePoint> ring_;
  /// The oldest point, which the next point replaces once the ring is full.
  std::size_t next_ = 0;
  TracePoint current_;
  bool has_current_ = false;
  std::int64_t interval_ = 0;  ///< The number of the interval under way.
};

}  // namespace jnd::app
