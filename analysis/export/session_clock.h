#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/sample.h"
#include "core/storage/study_rows.h"

namespace jnd::analysis {

/// Times of a session's events and ticks by one clock: the monotonic clock of the machine,
/// which streams of other recorders are corrected to. Events are stored with the time of the
/// day; how far the two are apart is known wherever a stream was opened, and else from events
/// whose tick is recorded. Ticks of a session in simulated time are counted from 0 at its rate,
/// as its events are. A machine that was started anew between two parts of a session has
/// another monotonic clock in the second: its times go on from the first by the time of the
/// day. Where the clock of the day was set meanwhile, events and samples keep their order. Not
/// real time.
class SessionClock {
 public:
  /// `events`: all of the session, by their sequence.
  SessionClock(std::vector<core::EventRow> events, double rate_hz);

  /// Takes each recorded sample, in the order of ticks, before any time is asked for.
  void take(const core::Sample& sample);
  /// Must be called after all samples were taken.
  void finish();

  [[nodiscard]] double time_s(const core::Sample& sample) const;
  [[nodiscard]] double time_s(const core::EventRow& event) const;
  /// To be added to times of the monotonic clock at this event; 0 unless the machine was
  /// started anew since the session began.
  [[nodiscard]] double shift_s(const core::EventRow& event) const;

 private:
  /// The part of a session between two starts of the program.
  struct Part {
    std::int64_t first_sequence = 0;
    std::int64_t first_tick = 0;
    std::optional<double> first_s, last_s;  ///< Of its samples, by the monotonic clock.
    std::optional<double> day_ahead_s;      ///< Of the monotonic clock, as a stream told it.
    std::vector<double> ahead_by_ticks_s;
    double ahead_s = 0.0;
    double shift_s = 0.0;
  };
  [[nodiscard]] std::size_t part_of_event(const core::EventRow& event) const;
  [[nodiscard]] std::size_t part_of_tick(std::int64_t tick) const;
  [[nodiscard]] std::optional<double> told_s(const core::EventRow& event) const;
  void join_parts();
  void order_events();

  double rate_hz_;
  std::vector<core::EventRow> events_;
  std::vector<Part> parts_;
  std::map<std::int64_t, double> tick_times_s_;   ///< Of ticks that events speak of.
  std::map<std::int64_t, double> event_times_s_;  ///< By sequence; in real time.
  bool is_simulated_ = true;
};

}  // namespace jnd::analysis
