#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/sample.h"
#include "core/storage/study_rows.h"

namespace jnd::analysis {

/// Converts times of a session's events and ticks to one clock: the machine's monotonic clock,
/// to which the streams of other recorders are corrected. Events are stored with the time of
/// day. The difference of the two clocks is known wherever a stream was opened, and otherwise
/// from events whose tick is recorded. Ticks of a session in simulated time are counted from 0
/// at its rate, as its events are. If the machine was restarted between two parts of a session,
/// its monotonic clock is a different one in the second part. Times then continue from the
/// first part by the time of day. Not real time.
class SessionClock {
 public:
  SessionClock(std::vector<core::EventRow> events, double rate_hz);

  /// Takes each recorded sample, in the order of ticks, before any time is asked for.
  void take(const core::Sample& sample);
  /// Must be called after all samples were taken.
  void finish();

  [[nodiscard]] double time_s(const core::Sample& sample) const;
  [[nodiscard]] double time_s(const core::EventRow& event) const;
  /// The number of seconds to add to times of the monotonic clock at this time of day. It is 0
  /// unless the machine was restarted after the session began.
  [[nodiscard]] double shift_s(std::int64_t day_time_ns) const;

 private:
  /// The part of a session between two starts of the program.
  struct Part {
    std::int64_t first_time_ns = 0;  ///< The time of day.
    std::int64_t first_tick = 0;
    /// How far the time of day is ahead of the monotonic clock, as a stream reported it.
    std::optional<double> day_ahead_s;
    std::vector<double> ahead_by_ticks_s;
    double ahead_s = 0.0;
    double shift_s = 0.0;
  };
  [[nodiscard]] std::size_t part_of_time(std::int64_t day_time_ns) const;
  [[nodiscard]] const Part& part_of_tick(std::int64_t tick) const;

  double rate_hz_;
  std::vector<core::EventRow> events_;
  std::vector<Part> parts_;
  std::map<std::int64_t, double> tick_times_s_;  ///< The times of ticks that events mention.
  bool is_simulated_ = true;
};

}  // namespace jnd::analysis
