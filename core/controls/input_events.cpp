#include "core/controls/input_events.h"

#include <libevdev/libevdev.h>
#include <linux/input.h>

#include <cstring>

namespace jnd::core {
namespace {

std::string code_name(unsigned type, unsigned code) {
  const char* name = ::libevdev_event_code_get_name(type, code);
  if (name != nullptr) return name;
  return (type == EV_KEY ? "KEY_" : "ABS_") + std::to_string(code);
}

std::int64_t time_of(const input_event& event) {
  return std::int64_t{event.input_event_sec} * 1'000'000'000 +
         std::int64_t{event.input_event_usec} * 1'000;
}

bool is_hat(unsigned code) { return code >= ABS_HAT0X && code <= ABS_HAT3Y; }

}  // namespace

std::vector<ControlEvent> InputEvents::take(std::span<const std::byte> bytes) {
  rest_.insert(rest_.end(), bytes.begin(), bytes.end());
  std::vector<ControlEvent> events;
  std::size_t taken = 0;
  for (; rest_.size() - taken >= sizeof(input_event); taken += sizeof(input_event)) {
    take_one(rest_.data() + taken, events);
  }
  rest_.erase(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(taken));
  return events;
}

void InputEvents::take_one(const std::byte* bytes, std::vector<ControlEvent>& events) {
  input_event event{};
  std::memcpy(&event, bytes, sizeof event);
  const std::int64_t time_ns = time_of(event);
  if (event.type == EV_SYN && event.code == SYN_DROPPED) {
    is_dropping_ = true;
    const std::set<std::string> down = down_;
    for (const std::string& name : down) change(name, false, time_ns, events);
  } else if (event.type == EV_SYN && event.code == SYN_REPORT) {
    is_dropping_ = false;
  }
  if (is_dropping_) return;
  constexpr int kRepeat = 2;
  if (event.type == EV_KEY && event.value != kRepeat) {
    change(code_name(EV_KEY, event.code), event.value != 0, time_ns, events);
  } else if (event.type == EV_ABS && is_hat(event.code)) {
    const std::string name = code_name(EV_ABS, event.code);
    if (event.value >= 0) change(name + '-', false, time_ns, events);
    if (event.value <= 0) change(name + '+', false, time_ns, events);
    if (event.value != 0) change(name + (event.value < 0 ? '-' : '+'), true, time_ns, events);
  }
}

void InputEvents::change(const std::string& name, bool is_down, std::int64_t time_ns,
                         std::vector<ControlEvent>& events) {
  const bool is_new = is_down ? down_.insert(name).second : down_.erase(name) > 0;
  if (!is_new) return;
  events.push_back({.control = {device_, name}, .is_down = is_down, .monotonic_ns = time_ns});
}

}  // namespace jnd::core
