#pragma once

#include <functional>
#include <optional>

#include "device/check/device_rule.h"
#include "device/check/hand_check.h"
#include "device/haptic_device.h"

namespace jnd::device {

struct DriverCheck {
  /// Whether the hand may be pushed. Never set it with a person's hand in the device. A
  /// simulation is pushed by 2 N, a real device by 0.5 N.
  bool pushes = false;
  /// If false, ticks follow each other at once, for a simulation without a clock of its own.
  bool is_paced = true;
  /// The program is to stop: no force then, the device is closed, and `core::Error` is thrown.
  std::function<bool()> is_cancelled{};
  /// A person moves it as the prompts say, and nothing pushes it: how long one prompt is; none:
  /// nobody does.
  std::optional<double> by_hand_step_s{};
  TellPrompt prompt{};
};

/// Tests what `HapticDevice` promises with a device that is closed: it opens, is punctual,
/// reports units, frame and time correctly, follows a push and halts, and opens again. This
/// takes some ten seconds. Returns whether no rule is broken, with the device closed. Not real
/// time.
[[nodiscard]] bool check_driver(HapticDevice& device, const DriverCheck& check,
                                const TellOutcome& tell);

}  // namespace jnd::device
