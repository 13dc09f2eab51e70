#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/haptic_state.h"
#include "device/check/device_rule.h"
#include "device/haptic_device.h"

namespace jnd::device {

/// What a person is asked to do with the device now.
struct HandPrompt {
  std::string_view step;  ///< "right", as programs tell them apart.
  std::string text;       ///< "Move the hand 10 cm to your right, and hold it there."
  double left_s = 0.0;    ///< Until the next step.
};

/// Is told each prompt when it begins, and every second after.
using TellPrompt = std::function<void(const HandPrompt&)>;

struct HandCheck {
  DeviceCapabilities can;
  double step_s = 4.0;  ///< Of one prompt, >= 0.2; some take half or twice as long.
  /// The measurements of so many seconds, in which the device is given no force.
  std::function<std::vector<core::HapticState>(double duration_s)> watch;
  TellPrompt prompt;
};

/// Tries what only a person who moves the device can find out: that it tells rest, directions,
/// order of points, buttons, gripper and workspace truly. No force is given. Not real time.
void check_by_hand(const HandCheck& check, RuleJudge& judge);

/// All of these rules, with this reason.
void skip_by_hand(RuleJudge& judge, const std::string& why);

}  // namespace jnd::device
