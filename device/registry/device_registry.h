#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "device/haptic_device.h"

namespace jnd::device {

/// One line of the table of devices.
struct DeviceEntry {
  std::string_view name;         ///< As after `--device`.
  std::string_view argument;     ///< What follows the name and a colon, "HOST:PORT"; or "".
  std::string_view description;  ///< One phrase for people.
  /// The device with its default settings, not opened, for a loop of this rate. Throws
  /// `core::Error` for an argument or a rate it cannot do. Not real time.
  std::unique_ptr<HapticDevice> (*make)(std::string_view argument, double rate_hz);
  /// What may follow instead, "OPTION,..."; or "".
  std::string_view optional_argument;
};

/// What stands before the first colon of a device's name, and what after it. Real time.
[[nodiscard]] std::string_view kind_of(std::string_view name) noexcept;
[[nodiscard]] std::string_view argument_of(std::string_view name) noexcept;

/// Every device of this program; the first is the default.
[[nodiscard]] std::span<const DeviceEntry> devices() noexcept;

/// The entry for "lumped" or "network:127.0.0.1:4700". Throws `core::Error`, listing the names
/// there are, or saying which argument is wanted. Not real time.
[[nodiscard]] const DeviceEntry& device_named(std::string_view name);

/// Throws as `device_named` and the entry's `make` do, and `DeviceUnreachable` for one that has
/// to be asked what it can do and does not answer. Not real time.
[[nodiscard]] std::unique_ptr<HapticDevice> make_device(std::string_view name, double rate_hz);

class NetworkDevice;

/// What answers at "127.0.0.1:4700,key=robot", to look at what it says of itself: whether it is
/// a simulation is not compared with the options. Throws as `make_device`. Not real time.
[[nodiscard]] std::unique_ptr<NetworkDevice> asked_network_device(std::string_view argument);

}  // namespace jnd::device
