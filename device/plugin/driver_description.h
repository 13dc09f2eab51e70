#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/haptic_state.h"
#include "core/safety/fault.h"
#include "device/haptic_device.h"
#include "device/plugin/jnd_device.h"

namespace jnd::device {

/// Takes nothing that a driver says of its device on trust. Throws `core::Error` naming the
/// field, in words for whoever writes the driver. Not real time.
void require_description(const jnd_device_description& description);

/// Likewise, that an open device is the one that was described: all but serial and firmware.
void require_same_device(const jnd_device_description& before,
                         const jnd_device_description& now);

/// Of a description that passed, for a loop of this rate. `believes_simulated`: what it says of
/// itself, that nobody can be hurt by it, is taken for true. Real time.
[[nodiscard]] DeviceCapabilities capabilities_of(const jnd_device_description& description,
                                                 double rate_hz,
                                                 bool believes_simulated) noexcept;

/// Throws `core::Error`, beginning with `place`: a device with its own clock that is slower
/// than a loop of this rate, or paces it at another. Not real time.
void require_rate(const jnd_device_description& description, double rate_hz,
                  const std::string& place);

/// Not real time.
[[nodiscard]] DeviceIdentity identity_of(const jnd_device_description& description);

/// The measurement as the loop has it, or what is wrong with it: a number that is none, a
/// point, switch or orientation that there cannot be. `state` is then undefined. Real time.
[[nodiscard]] core::Fault checked_state(const jnd_device_description& description,
                                        const jnd_device_state& measured,
                                        core::HapticState& state) noexcept;

/// Which field of a measurement that `checked_state` refuses is wrong, and how. Real time.
[[nodiscard]] const char* state_problem(const jnd_device_description& description,
                                        const jnd_device_state& measured) noexcept;

/// How long forces may last without another command, in seconds: by the watchdogs on either
/// side. Longer where nobody can be hurt. Real time.
[[nodiscard]] double command_timeout_s(bool simulated) noexcept;

/// What the device has, "enable_switch", in the order of the flags. Not real time.
[[nodiscard]] std::vector<std::string> features_of(const jnd_device_description& description);

}  // namespace jnd::device
