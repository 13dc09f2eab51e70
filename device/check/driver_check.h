#pragma once

#include <functional>
#include <optional>

#include "device/check/device_rule.h"
#include "device/check/hand_check.h"
#include "device/haptic_device.h"

namespace jnd::device {

struct DriverCheck {
  /// Whether the hand may be pushed: never with a person's hand in the device. A simulation is
  /// pushed by 2 N, a real one by 0.5 N.
  bool pushes = false;
  /// Else one tick follows the other at once: of a simulation without a clock of its own.
  bool is_paced = true;
  /// The program is to stop: no force then, the device is closed, and `core::Error` is thrown.
  std::function<bool()> is_cancelled{};
  /// A person moves it as the prompts say, and nothing pushes it: how long one prompt is; none:
  /// nobody does.
  std::optional<double> by_hand_step_s{};
  TellPrompt prompt{};
};

/// Tries what `HapticDevice` promises of a device that is closed: it opens, is punctual, tells
/// units, frame and time truly, follows a push and halts, and opens again. Some ten seconds.
/// Whether no rule is broken; the device is closed afterwards. Not real time.
[[nodiscard]] bool check_driver(HapticDevice& device, const DriverCheck& check,
                                const TellOutcome& tell);

}  // namespace jnd::device
