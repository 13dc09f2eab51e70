#include "analysis/export/session_clock.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/sample_table.h"

namespace jnd::analysis {
namespace {

constexpr double kSPerNs = 1e-9;
/// While a machine runs, its time of day is set by at most this. A larger jump means a restart.
constexpr double kAnotherStart_s = 1.0;

double day_s(std::int64_t time_ns) { return kSPerNs * static_cast<double>(time_ns); }

/// The tick at which the event happened, if the event states it.
std::optional<std::int64_t> tick_of(const core::EventRow& event) {
  if (event.kind == "trial_started" || event.kind == "presentation_started") {
    return event.first_tick;
  }
  if (event.kind == "presentation_ended") return event.last_tick;
  return std::nullopt;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// The time of our clock in a `stream_opened` event; absent for other events.
std::optional<double> monotonic_in(const core::EventRow& event) {
  if (event.kind != "stream_opened") return std::nullopt;
  const auto data = nlohmann::json::parse(event.data, nullptr, /*allow_exceptions=*/false);
  const auto told = data.is_object() ? data.find("monotonic_s") : data.end();
  if (!data.is_object() || told == data.end() || !told->is_number()) return std::nullopt;
  return told->get<double>();
}

}  // namespace

SessionClock::SessionClock(std::vector<core::EventRow> events, double rate_hz)
    : rate_hz_(rate_hz), events_(std::move(events)) {
  std::int64_t next_tick = 0;
  for (const core::EventRow& event : events_) {
    if (parts_.empty() || event.kind == "session_resumed") {
      parts_.push_back({.first_sequence = event.sequence,
                        .first_tick = event.kind == "session_resumed" && event.last_tick
                                          ? std::max(next_tick, *event.last_tick + 1)
                                          : next_tick});
    }
    if (const auto tick = tick_of(event)) {
      tick_times_s_.emplace(*tick, std::nan(""));
      next_tick = std::max(next_tick, *tick + 1);
    }
    Part& part = parts_.back();
    if (const auto told_s = monotonic_in(event); told_s && !part.day_ahead_s) {
      part.day_ahead_s = day_s(event.time_ns) - *told_s;
    }
  }
  if (parts_.empty()) parts_.emplace_back();
}

void SessionClock::take(const core::Sample& sample) {
  if (core::has_times(sample)) {
    is_simulated_ = false;
    Part& part = parts_[part_of_tick(sample.tick)];
    part.last_s = kSPerNs * static_cast<double>(sample.monotonic_ns);
    if (!part.first_s) part.first_s = part.last_s;
  }
  const auto asked = tick_times_s_.find(sample.tick);
  if (asked == tick_times_s_.end()) return;
  asked->second = is_simulated_ ? static_cast<double>(sample.tick) / rate_hz_
                                : kSPerNs * static_cast<double>(sample.monotonic_ns);
}

void SessionClock::finish() {
  if (is_simulated_) {
    for (auto& [tick, time_s] : tick_times_s_) time_s = static_cast<double>(tick) / rate_hz_;
    return;
  }
  for (const core::EventRow& event : events_) {
    const auto tick = tick_of(event);
    if (!tick || !std::isfinite(tick_times_s_.at(*tick))) continue;
    parts_[part_of_event(event)].ahead_by_ticks_s.push_back(day_s(event.time_ns) -
                                                            tick_times_s_.at(*tick));
  }
  double known_s = 0.0;
  for (Part& part : parts_) {
    if (part.day_ahead_s) {
      part.ahead_s = *part.day_ahead_s;
    } else if (!part.ahead_by_ticks_s.empty()) {
      part.ahead_s = median_of(part.ahead_by_ticks_s);
    } else {
      part.ahead_s = known_s;  // Nothing in this part contradicts the known difference.
    }
    known_s = part.ahead_s;
  }
  join_parts();
  order_events();
}

/// By how much the clock of each part has to be put on, so that none begins before the end of
/// the one before.
void SessionClock::join_parts() {
  double shift_s = 0.0;
  std::optional<double> last_s;
  for (Part& part : parts_) {
    const double leap_s = part.ahead_s - parts_.front().ahead_s;
    // No machine starts earlier than it did before: less is a clock of the day that was set
    // back.
    if (leap_s < shift_s - kAnotherStart_s) {
      part.shift_s = shift_s;
    } else if (leap_s > kAnotherStart_s) {
      part.shift_s = leap_s;
    }
    if (last_s && part.first_s) {
      part.shift_s = std::max(part.shift_s, *last_s + 1.0 / rate_hz_ - *part.first_s);
    }
    shift_s = part.shift_s;
    if (part.last_s) last_s = *part.last_s + shift_s;
  }
}

/// What is told of no tick happened between what is told of the ticks around it, whatever the
/// clock of the day says.
void SessionClock::order_events() {
  std::vector<double> latest_s(events_.size() + 1, std::numeric_limits<double>::infinity());
  for (std::size_t i = events_.size(); i-- > 0;) {
    latest_s[i] = std::min(latest_s[i + 1], told_s(events_[i]).value_or(latest_s[i + 1]));
  }
  double before_s = -std::numeric_limits<double>::infinity();
  std::size_t place = 0;
  // By how much the clock of the day is ahead since it was set within a part.
  bool was_set = false;
  double set_ahead_s = 0.0;
  for (std::size_t i = 0; i < events_.size(); ++i) {
    const core::EventRow& event = events_[i];
    if (part_of_event(event) != std::exchange(place, part_of_event(event))) was_set = false;
    const Part& part = parts_[place];
    double time_s = 0.0;
    if (const std::optional<double> told = told_s(event)) {
      time_s = *told;
      const double ahead_s = day_s(event.time_ns) - (*told - part.shift_s);
      was_set = std::abs(ahead_s - part.ahead_s) > kAnotherStart_s;
      set_ahead_s = ahead_s;
    } else {
      const double by_day_s =
          day_s(event.time_ns) - (was_set ? set_ahead_s : part.ahead_s) + part.shift_s;
      time_s = std::max(before_s, std::min(by_day_s, latest_s[i]));
    }
    event_times_s_[event.sequence] = time_s;
    before_s = std::max(before_s, time_s);
  }
}

std::size_t SessionClock::part_of_event(const core::EventRow& event) const {
  const auto next = std::ranges::upper_bound(parts_, event.sequence, {}, &Part::first_sequence);
  return next == parts_.begin() ? 0 : static_cast<std::size_t>(next - parts_.begin()) - 1;
}

std::size_t SessionClock::part_of_tick(std::int64_t tick) const {
  const auto next = std::ranges::upper_bound(parts_, tick, {}, &Part::first_tick);
  return next == parts_.begin() ? 0 : static_cast<std::size_t>(next - parts_.begin()) - 1;
}

/// By the sample of the tick that the event tells, where there is one.
std::optional<double> SessionClock::told_s(const core::EventRow& event) const {
  const auto tick = tick_of(event);
  if (!tick) return std::nullopt;
  const auto found = tick_times_s_.find(*tick);
  if (found == tick_times_s_.end() || !std::isfinite(found->second)) return std::nullopt;
  return found->second + (is_simulated_ ? 0.0 : parts_[part_of_tick(*tick)].shift_s);
}

double SessionClock::time_s(const core::Sample& sample) const {
  if (is_simulated_) return static_cast<double>(sample.tick) / rate_hz_;
  return kSPerNs * static_cast<double>(sample.monotonic_ns) +
         parts_[part_of_tick(sample.tick)].shift_s;
}

double SessionClock::time_s(const core::EventRow& event) const {
  if (const std::optional<double> told = told_s(event)) return *told;
  if (is_simulated_) return day_s(event.time_ns);
  return event_times_s_.at(event.sequence);
}

double SessionClock::shift_s(const core::EventRow& event) const {
  return is_simulated_ ? 0.0 : parts_[part_of_event(event)].shift_s;
}

}  // namespace jnd::analysis
