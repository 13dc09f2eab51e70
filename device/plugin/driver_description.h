#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/haptic_state.h"
#include "core/safety/fault.h"
#include "device/haptic_device.h"
#include "device/plugin/jnd_device.h"

namespace jnd::device {

/// Checks everything that a driver says about its device. Throws `core::Error` naming the
/// field, in words for the driver's author. Not real time.
void require_description(const jnd_device_description& description);

/// Checks that an open device is the one that was described; only serial and firmware may
/// differ. Throws `core::Error`. Not real time.
void require_same_device(const jnd_device_description& before,
                         const jnd_device_description& now);

/// Returns the capabilities for a description that passed the check, and a loop of this rate.
/// `believes_simulated` says whether to believe the device that nobody can be hurt by it. Real
/// time.
[[nodiscard]] DeviceCapabilities capabilities_of(const jnd_device_description& description,
                                                 double rate_hz,
                                                 bool believes_simulated) noexcept;

/// Throws `core::Error`, beginning with `place`, if a device with its own clock is slower than
/// a loop of this rate, or paces it at another rate. Not real time.
void require_rate(const jnd_device_description& description, double rate_hz,
                  const std::string& place);

/// Not real time.
[[nodiscard]] DeviceIdentity identity_of(const jnd_device_description& description);

/// Converts the measurement for the loop. Returns a fault if it has an invalid number, point,
/// switch or orientation; `state` is then undefined. Real time.
[[nodiscard]] core::Fault checked_state(const jnd_device_description& description,
                                        const jnd_device_state& measured,
                                        core::HapticState& state) noexcept;

/// Which field of a measurement that `checked_state` refuses is wrong, and how. Real time.
[[nodiscard]] const char* state_problem(const jnd_device_description& description,
                                        const jnd_device_state& measured) noexcept;

/// How long forces may last without another command, in seconds: by the watchdogs on either
/// side. Longer where nobody can be hurt. Real time.
[[nodiscard]] double command_timeout_s(bool simulated) noexcept;

/// Returns what the device has, such as "enable_switch", in the order of the flags. Not real
/// time.
[[nodiscard]] std::vector<std::string> features_of(const jnd_device_description& description);

}  // namespace jnd::device
