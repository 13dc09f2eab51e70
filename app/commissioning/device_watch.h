#pragma once

#include <string>
#include <vector>

#include "core/exchange/telemetry.h"
#include "device/haptic_device.h"

namespace jnd::app {

/// What a device tells at this moment, in words such as "Enabling switch" and "open".
struct WatchedLine {
  std::string what, value;
};

/// The lines for what the device has: its enabling switch, its buttons, the place of its first
/// contact point, the speed of its hand, and the values of its sensors. Places are in the
/// device's own frame.
[[nodiscard]] std::vector<WatchedLine> watched_lines(const device::DeviceCapabilities& can,
                                                     const core::Telemetry& telemetry);

}  // namespace jnd::app
