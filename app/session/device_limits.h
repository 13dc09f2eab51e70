#pragma once

#include <optional>
#include <string>

#include "app/profile/known_profile.h"
#include "app/session/stability_limits.h"
#include "device/haptic_device.h"

namespace jnd::app {

/// The limits with which a study's stimuli are compared.
struct DeviceLimits {
  device::DeviceCapabilities can;
  std::optional<StabilityMap> stability;  ///< None if nobody measured it.
};

/// If there is a profile, the limits come from what was measured of the device; otherwise from
/// what it says about itself and from the shipped map. Asks the device without opening it;
/// throws as `device::make_device` does.
[[nodiscard]] DeviceLimits limits_of_device(const std::string& device, double rate_hz,
                                            const std::optional<KnownProfile>& known);

/// The stability in a profile, as a map of one rate whose phantom stands for a hand; none if it
/// was not measured.
[[nodiscard]] std::optional<StabilityMap> stability_map_of(
    const std::string& device, const experiments::DeviceProfile& profile);

}  // namespace jnd::app
