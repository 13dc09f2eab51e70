#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::core {

/// Something that can be pressed: a key or button of an input device, a direction of a hat, or
/// a byte that a serial box sends. Two devices of the same model count as one.
struct Control {
  std::string device;  ///< "0c45:7403 FootSwitch", "serial /dev/ttyUSB1"
  std::string name;    ///< "KEY_B", "BTN_SOUTH", "ABS_HAT0X-", "byte 49"

  // clang-tidy 14 mistakes what the compiler generates for this operator for a null pointer.
  friend auto operator<=>(const Control&,
                          const Control&) = default;  // NOLINT(modernize-use-nullptr)
};

/// Returns words for people, such as "FootSwitch: B".
[[nodiscard]] std::string words_of(const Control& control);
/// Returns the form that is stored with an answer, such as "0c45:7403 FootSwitch/KEY_B".
[[nodiscard]] std::string stored_words(const Control& control);

/// A control went down or up. A serial box reports only presses, so its bytes count as released
/// at once.
struct ControlEvent {
  Control control;
  bool is_down = false;
  /// Time by CLOCK_MONOTONIC. It is the kernel's time stamp, or the time when the byte of a
  /// serial box was read.
  std::int64_t monotonic_ns = 0;
};

/// What a control can do in a session, as a machine's file spells it. The last two are the
/// participant's emergency stop: a press of "stop" ends the force, and "hold" allows force only
/// while it is held.
inline constexpr std::array<std::string_view, 24> kControlActions = {
    "first",   "second",  "third",  "yes",     "no",         "cannot_tell",
    "present", "matches", "lower",  "raise",   "lower_fine", "raise_fine",
    "step_1",  "step_2",  "step_3", "step_4",  "step_5",     "step_6",
    "step_7",  "step_8",  "step_9", "step_10", "stop",       "hold"};

/// The assignment of controls to actions on this machine.
class ControlMap {
 public:
  struct Row {
    std::string action;
    Control control;

    friend bool operator==(const Row&, const Row&) = default;
  };

  [[nodiscard]] const std::vector<Row>& rows() const noexcept { return rows_; }
  /// Assigns a control to an action. Each action has one control and each control one action,
  /// so earlier assignments of either are removed. Throws `Error` for an unknown action.
  void set(const std::string& action, const Control& control);
  void forget(const std::string& action);
  /// Returns "" if the control has no action.
  [[nodiscard]] std::string action_of(const Control& control) const;
  /// Returns nullptr if the action has no control.
  [[nodiscard]] const Control* control_of(std::string_view action) const;
  [[nodiscard]] bool names(const std::string& device) const;

  friend bool operator==(const ControlMap&, const ControlMap&) = default;

 private:
  std::vector<Row> rows_;
};

}  // namespace jnd::core
