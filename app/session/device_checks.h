#pragma once

#include <string>

#include "device/haptic_device.h"
#include "experiments/session/plan.h"

namespace jnd::app {

// Whether a session can run on a device that was named.

/// Throws `UsageError` if no device has this name.
void require_device(const std::string& name);

/// Simulated participants have no hand of their own, so this throws `UsageError` "PLACE:
/// expected a device that moves by itself, ..." for a device that a person has to move. `place`
/// says where the name comes from, such as "--device mouse".
void require_device_moves_by_itself(const std::string& name, const std::string& place);

/// A message such as "expected a device that holds 5 points of the hand, ..." if the device
/// holds fewer than the study asks for; otherwise "".
[[nodiscard]] std::string missing_points_words(const std::string& device,
                                               const device::DeviceCapabilities& can,
                                               int min_contact_points);
/// Throws `UsageError` with that message.
void require_device_holds(const std::string& name, double rate_hz, int min_contact_points);

/// True if a session on the device runs in real time, whatever was asked for.
[[nodiscard]] bool has_own_clock(const std::string& device);

/// For many sessions that run as fast as possible: throws `UsageError` for a device with a
/// clock of its own. `place` says where the name comes from, such as "--device mouse".
void require_device_keeps_pace(const std::string& name, const std::string& place);

/// Opens a simulated device once and closes it, so that nothing is stored for a session that
/// cannot begin. A real device is left alone, because its motors may turn on. Throws
/// `EnvironmentError` with what the device says.
void require_device_starts(const std::string& name, double rate_hz);

/// What a study's stimuli have to keep within on this device: no more than it renders, and no
/// more than this program's own limiter lets through.
[[nodiscard]] experiments::RangeLimits range_limits_of(const device::DeviceCapabilities& can,
                                                       double expected_speed_m_per_s);

/// A fault of the loop in words, with what the device's own program says about it, if anything.
/// If that program does not answer any more, its silence was the cause, whatever the loop
/// noticed of it first.
[[nodiscard]] std::string fault_words(core::Fault fault, const std::string& said_by_device,
                                      bool device_answers);

/// "this program renders at most 10 N at a point and 30 N in all, although `NAME` says 15 N and
/// 40 N": where the device says more than the program gives; else "".
[[nodiscard]] std::string own_limit_words(const std::string& device,
                                          const device::DeviceCapabilities& can);

}  // namespace jnd::app
