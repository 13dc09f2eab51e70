#include "app/session/device_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/command_line/command.h"
#include "core/error.h"
#include "core/safety/force_limiter.h"
#include "device/registry/device_registry.h"

namespace jnd::app {

void require_device(const std::string& name) {
  try {
    (void)device::device_named(name);
  } catch (const core::Error& error) {
    throw UsageError(std::string("--device: ") + error.what());
  }
}

constexpr double kUsualRateHz = 1000.0;

void require_device_moves_by_itself(const std::string& name, const std::string& place) {
  if (device::make_device(name, kUsualRateHz)->capabilities().moves_by_itself) return;
  throw UsageError(place +
                   ": expected a device that moves by itself, for participants that are "
                   "simulated, found one that a person has to move; choose another, see `jnd "
                   "devices`");
}

bool has_own_clock(const std::string& device) {
  return device::make_device(device, kUsualRateHz)->capabilities().has_own_clock;
}

void require_device_keeps_pace(const std::string& name, const std::string& place) {
  if (!has_own_clock(name)) return;
  throw UsageError(place +
                   ": expected a device that is simulated here, as fast as it goes, found one "
                   "with a clock of its own; run single sessions on it with `jnd run "
                   "--headless`");
}

void require_device_starts(const std::string& name, double rate_hz) {
  try {
    const std::unique_ptr<device::HapticDevice> device = device::make_device(name, rate_hz);
    // The motors of a real device turn on only after the check for real time, in
    // `start_haptics`.
    if (!device->capabilities().simulated) return;
    device->open();
    device->close();
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
}

std::string missing_points_words(const std::string& device,
                                 const device::DeviceCapabilities& can,
                                 int min_contact_points) {
  if (can.num_contact_points() >= min_contact_points) return "";
  return "expected a device that holds " + std::to_string(min_contact_points) +
         " points of the hand, as the study's `min_contact_points` asks, found that `" +
         device + "` holds " + std::to_string(can.num_contact_points()) +
         "; ask for fewer or choose another device";
}

void require_device_holds(const std::string& name, double rate_hz, int min_contact_points) {
  const std::string missing = missing_points_words(
      name, device::make_device(name, rate_hz)->capabilities(), min_contact_points);
  if (!missing.empty()) throw UsageError("--device " + name + ": " + missing);
}

/// As the loop of a session has them.
constexpr core::ForceLimiter::Parameters kOwnLimits;

experiments::RangeLimits range_limits_of(const device::DeviceCapabilities& can,
                                         double expected_speed_m_per_s) {
  return {
      .max_force_per_point_n = std::min(can.max_force_per_point_n, kOwnLimits.per_point_n),
      .max_total_force_n = std::min(can.max_total_force_n, kOwnLimits.total_n),
      .largest_share_ratio = *std::max_element(can.share_ratio.begin(), can.share_ratio.end()),
      .expected_speed_m_per_s = expected_speed_m_per_s};
}

std::string fault_words(core::Fault fault, const std::string& said_by_device,
                        bool device_answers) {
  const bool is_of_silence = !device_answers && (fault == core::Fault::kStaleSample ||
                                                 fault == core::Fault::kHostTooSlow);
  if (is_of_silence) fault = core::Fault::kDeviceReadFailed;
  std::string told(core::words(fault));
  if (core::is_of_driver(fault) && !said_by_device.empty()) {
    told += " The driver says: " + said_by_device + ".";
  }
  return told;
}

std::string own_limit_words(const std::string& device, const device::DeviceCapabilities& can) {
  if (can.max_force_per_point_n <= kOwnLimits.per_point_n &&
      can.max_total_force_n <= kOwnLimits.total_n) {
    return "";
  }
  return fmt::format(
      "this program renders at most {:g} N at a point and {:g} N in all, although `{}` says "
      "{:g} N and {:g} N",
      kOwnLimits.per_point_n, kOwnLimits.total_n, device, can.max_force_per_point_n,
      can.max_total_force_n);
}

}  // namespace jnd::app
