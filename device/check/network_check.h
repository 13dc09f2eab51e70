#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "device/check/device_rule.h"
#include "device/check/hand_check.h"
#include "device/network/datagram_port.h"
#include "device/network/device_key.h"

namespace jnd::device {

struct NetworkCheck {
  /// Opens a port of ours towards the device. To the device, each port is another program.
  std::function<std::unique_ptr<DatagramPort>()> open_port;
  Address server;
  std::optional<DeviceKey> key;
  /// Whether the hand may be pushed. Never set it with a person's hand in the device. A
  /// simulation is pushed by 2 N, and asked for 100 N to test its limits; a real device is
  /// pushed by 0.5 N.
  bool pushes = false;
  /// The operator says that the device is a simulation. The device has to say so as well.
  bool believes_simulated = false;
  /// A person moves it as the prompts say, and nothing pushes it: how long one prompt is; none:
  /// nobody does.
  std::optional<double> by_hand_step_s{};
  TellPrompt prompt{};
};

/// Tests the rules of device/network/README.md at a device that nobody uses, one after another,
/// in some ten seconds. Returns whether no rule is broken. Throws `DeviceUnreachable` if
/// nothing answers or another program is connected. Not real time.
[[nodiscard]] bool check_network_device(const NetworkCheck& check, const TellOutcome& tell);

}  // namespace jnd::device
