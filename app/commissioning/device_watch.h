#pragma once

#include <string>
#include <vector>

#include "core/exchange/telemetry.h"
#include "device/haptic_device.h"

namespace jnd::app {

/// What a device tells at this moment, in words: "Enabling switch", "open".
struct WatchedLine {
  std::string what, value;
};

/// Of what the device has, and of nothing else: its enabling switch, its buttons, where its
/// first contact point and how fast its hand is, what its sensors measure. Places are in the
/// device's own frame.
[[nodiscard]] std::vector<WatchedLine> watched_lines(const device::DeviceCapabilities& can,
                                                     const core::Telemetry& telemetry);

}  // namespace jnd::app
