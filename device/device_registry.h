#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "device/haptic_device.h"

namespace jnd::device {

/// One line of the table of devices.
struct DeviceEntry {
  std::string_view name;         ///< As after `--device`.
  std::string_view description;  ///< One phrase for people.
  /// The device with its default settings, not opened, for a loop of this rate. Throws
  /// `core::Error` for a rate it cannot do. Not real time.
  std::unique_ptr<HapticDevice> (*make)(double rate_hz);
};

/// Every device of this program; the first is the default.
[[nodiscard]] std::span<const DeviceEntry> devices() noexcept;

/// Throws `core::Error`, listing the names there are. Not real time.
[[nodiscard]] const DeviceEntry& device_named(std::string_view name);

}  // namespace jnd::device
