#pragma once

#include <optional>
#include <string>

#include "app/profile/known_profile.h"
#include "app/session/stability_limits.h"
#include "device/haptic_device.h"

namespace jnd::app {

/// What the stimuli of a study are compared with.
struct DeviceLimits {
  device::DeviceCapabilities can;
  std::optional<StabilityMap> stability;  ///< None: nobody measured it.
};

/// By what was measured of the device, where there is a profile; else by what it says of itself
/// and the shipped map. Asks the device without opening it; throws as `device::make_device`.
[[nodiscard]] DeviceLimits limits_of_device(const std::string& device, double rate_hz,
                                            const std::optional<KnownProfile>& known);

/// The stability of a profile as a map of one rate, whose phantom stands for a hand; none where
/// it was not measured.
[[nodiscard]] std::optional<StabilityMap> stability_map_of(
    const std::string& device, const experiments::DeviceProfile& profile);

}  // namespace jnd::app
