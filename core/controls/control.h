#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::core {

/// One thing that can be pressed: a key or button of an input device, a direction of a hat, a
/// byte that a serial box sends. Two devices of one model count as one.
struct Control {
  std::string device;  ///< "0c45:7403 FootSwitch", "serial /dev/ttyUSB1"
  std::string name;    ///< "KEY_B", "BTN_SOUTH", "ABS_HAT0X-", "byte 49"

  // clang-tidy 14 takes what the compiler writes for this one for a null pointer.
  friend auto operator<=>(const Control&,
                          const Control&) = default;  // NOLINT(modernize-use-nullptr)
};

/// "FootSwitch: B", for people.
[[nodiscard]] std::string words_of(const Control& control);
/// "0c45:7403 FootSwitch/KEY_B", as it is stored with an answer.
[[nodiscard]] std::string stored_words(const Control& control);

/// It went down or up. A serial box tells of presses alone: its bytes go up at once.
struct ControlEvent {
  Control control;
  bool is_down = false;
  /// Of CLOCK_MONOTONIC: the kernel's own, of a serial box when its byte was read.
  std::int64_t monotonic_ns = 0;
};

/// What a control can do in a session, as the file of a machine names it. The last two are the
/// participant's emergency stop: pressing it stops, or force is there only while it is held.
inline constexpr std::array<std::string_view, 24> kControlActions = {
    "first",   "second",  "third",  "yes",     "no",         "cannot_tell",
    "present", "matches", "lower",  "raise",   "lower_fine", "raise_fine",
    "step_1",  "step_2",  "step_3", "step_4",  "step_5",     "step_6",
    "step_7",  "step_8",  "step_9", "step_10", "stop",       "hold"};

/// Which control does what, on this machine.
class ControlMap {
 public:
  struct Row {
    std::string action;
    Control control;

    friend bool operator==(const Row&, const Row&) = default;
  };

  [[nodiscard]] const std::vector<Row>& rows() const noexcept { return rows_; }
  /// One control for each action, and one action for each control: what was mapped before goes.
  /// Throws `Error` for an action that is none.
  void set(const std::string& action, const Control& control);
  void forget(const std::string& action);
  /// "" where it does nothing.
  [[nodiscard]] std::string action_of(const Control& control) const;
  /// nullptr where there is none.
  [[nodiscard]] const Control* control_of(std::string_view action) const;
  [[nodiscard]] bool names(const std::string& device) const;

  friend bool operator==(const ControlMap&, const ControlMap&) = default;

 private:
  std::vector<Row> rows_;
};

}  // namespace jnd::core
