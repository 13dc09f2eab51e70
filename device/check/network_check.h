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
  /// A port of our own toward the device; each is another program to it.
  std::function<std::unique_ptr<DatagramPort>()> open_port;
  Address server;
  std::optional<DeviceKey> key;
  /// Whether the hand may be pushed: never with a person's hand in the device. A simulation is
  /// pushed by 2 N, and asked for 100 N to see its limits; a real one by 0.5 N.
  bool pushes = false;
  /// The operator says that it is a simulation, and it has to say so, too.
  bool believes_simulated = false;
  /// A person moves it as the prompts say, and nothing pushes it: how long one prompt is; none:
  /// nobody does.
  std::optional<double> by_hand_step_s{};
  TellPrompt prompt{};
};

/// Tries the rules of device/network/README.md at a device that nobody uses, one after the
/// other, in some ten seconds. Throws `DeviceUnreachable` where nothing answers or another
/// program is connected. Whether no rule is broken. Not real time.
[[nodiscard]] bool check_network_device(const NetworkCheck& check, const TellOutcome& tell);

}  // namespace jnd::device
