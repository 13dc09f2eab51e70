#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/controls/control.h"

namespace jnd::core {

/// Makes presses of what the kernel's evdev writes, `struct input_event` by `input_event`
/// (linux/input.h), wherever they are read from. Keys, buttons and hats count; axes that are
/// analogue and repeats of a held key do not. Where the kernel says that it dropped events
/// (SYN_DROPPED), what was down counts as let go, for nobody knows. Not real time.
class InputEvents {
 public:
  explicit InputEvents(std::string device) : device_(std::move(device)) {}

  /// The bytes that came; an event that has not come whole waits for the rest.
  [[nodiscard]] std::vector<ControlEvent> take(std::span<const std::byte> bytes);
  /// Something is down: who takes the device for themselves now leaves others with a key that
  /// never comes up.
  [[nodiscard]] bool any_down() const noexcept { return !down_.empty(); }
  /// Down before anybody listened; it is told when it comes up.
  void note_down(const std::string& name) { down_.insert(name); }

 private:
  void take_one(const std::byte* bytes, std::vector<ControlEvent>& events);
  void change(const std::string& name, bool is_down, std::int64_t time_ns,
              std::vector<ControlEvent>& events);

  std::string device_;
  std::vector<std::byte> rest_;
  std::set<std::string> down_;
  bool is_dropping_ = false;
};

}  // namespace jnd::core
