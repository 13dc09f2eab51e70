#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/controls/control.h"

namespace jnd::core {

/// Turns what the kernel's evdev writes into presses, one `struct input_event` (linux/input.h)
/// after another, whatever their source. Keys, buttons and hats count; analogue axes and
/// repeats of a held key do not. If the kernel reports that it dropped events (SYN_DROPPED),
/// everything that was down counts as released, because its state is unknown. Not real time.
class InputEvents {
 public:
  explicit InputEvents(std::string device) : device_(std::move(device)) {}

  /// Takes the bytes that have arrived. An incomplete event waits for the rest of its bytes.
  [[nodiscard]] std::vector<ControlEvent> take(std::span<const std::byte> bytes);
  /// Whether something is down. Taking the device exclusively now would leave other programs
  /// with a key that never comes up.
  [[nodiscard]] bool any_down() const noexcept { return !down_.empty(); }
  /// Notes a key that was down before anybody listened. Its release is reported.
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
