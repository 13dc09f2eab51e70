#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/sample.h"

namespace jnd::app {

/// One short interval of how the hand moved, workspace frame.
struct TracePoint {
  double time_s = 0.0;  ///< Of the interval's first tick: ticks over the loop's rate.
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< Mean of the tips at the interval's end.
  double speed_m_per_s = 0.0;  ///< The largest in the interval, of the tips' mean velocity.
  double force_n = 0.0;        ///< The largest in the interval, of the force on the hand.
};

/// The last seconds of the hand, for plots: every sample goes in, about a hundred points a
/// second are kept, and no peak of speed or force is lost between them. What is not finite is
/// left out. Lost samples leave a gap in time; samples of an earlier time begin it anew.
///
/// Samples come from one thread; a picture may be taken from any. Not real time.
class LiveTrace {
 public:
  struct Parameters {
    double rate_hz = 1000.0;      ///< Of the loop, > 0.
    double duration_s = 10.0;     ///< How much is kept, > 0.
    double points_per_s = 100.0;  ///< > 0; at most one a tick.
  };

  /// Throws `core::Error` naming the field.
  explicit LiveTrace(const Parameters& parameters);

  void take(const core::Sample& sample);
  /// The points of the last `duration_s`, the oldest first; the interval under way is not in.
  [[nodiscard]] std::vector<TracePoint> snapshot() const;
  void clear();

 private:
  // With the lock held.
  void finish_interval();
  void start_anew();
  [[nodiscard]] const TracePoint& newest() const;

  Parameters parameters_;
  std::int64_t ticks_per_point_ = 1;
  std::size_t capacity_ = 1;

  mutable std::mutex mutex_;
  std::vector<TracePoint> ring_;
  std::size_t next_ = 0;  ///< The oldest: where the next point goes once the ring is full.
  TracePoint current_;
  bool has_current_ = false;
  std::int64_t interval_ = 0;  ///< Number of the interval under way.
};

}  // namespace jnd::app
