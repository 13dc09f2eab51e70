#include "analysis/export/session_clock.h"

#include <algorithm>
#include <cmath>
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
      parts_.push_back({.first_time_ns = event.time_ns,
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
  if (core::has_times(sample)) is_simulated_ = false;
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
    parts_[part_of_time(event.time_ns)].ahead_by_ticks_s.push_back(day_s(event.time_ns) -
                                                                   tick_times_s_.at(*tick));
  }
  bool is_known = false;
  double known_s = 0.0;
  for (Part& part : parts_) {
    if (part.day_ahead_s) {
      part.ahead_s = *part.day_ahead_s;
    } else if (!part.ahead_by_ticks_s.empty()) {
      part.ahead_s = median_of(part.ahead_by_ticks_s);
    } else {
      part.ahead_s = known_s;  // Nothing in this part contradicts the known difference.
    }
    if (!is_known) known_s = part.ahead_s;
    is_known = true;
    const double leap_s = part.ahead_s - parts_.front().ahead_s;
    if (std::abs(leap_s) > kAnotherStart_s) part.shift_s = leap_s;
  }
}

std::size_t SessionClock::part_of_time(std::int64_t day_time_ns) const {
  const auto next = std::ranges::upper_bound(parts_, day_time_ns, {}, &Part::first_time_ns);
  return next == parts_.begin() ? 0 : static_cast<std::size_t>(next - parts_.begin()) - 1;
}

const SessionClock::Part& SessionClock::part_of_tick(std::int64_t tick) const {
  const auto next = std::ranges::upper_bound(parts_, tick, {}, &Part::first_tick);
  return next == parts_.begin() ? parts_.front() : *(next - 1);
}

double SessionClock::time_s(const core::Sample& sample) const {
  if (is_simulated_) return static_cast<double>(sample.tick) / rate_hz_;
  return kSPerNs * static_cast<double>(sample.monotonic_ns) + part_of_tick(sample.tick).shift_s;
}

double SessionClock::time_s(const core::EventRow& event) const {
  if (const auto tick = tick_of(event)) {
    const double told_s = tick_times_s_.at(*tick);
    if (std::isfinite(told_s)) {
      return told_s + (is_simulated_ ? 0.0 : part_of_tick(*tick).shift_s);
    }
  }
  if (is_simulated_) return day_s(event.time_ns);
  const Part& part = parts_[part_of_time(event.time_ns)];
  return day_s(event.time_ns) - part.ahead_s + part.shift_s;
}

double SessionClock::shift_s(std::int64_t day_time_ns) const {
  return is_simulated_ ? 0.0 : parts_[part_of_time(day_time_ns)].shift_s;
}

}  // namespace jnd::analysis
