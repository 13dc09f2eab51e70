#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "device/haptic_device.h"

namespace jnd::device {

/// One line of the table of devices.
struct DeviceEntry {
  std::string_view name;         ///< As after `--device`.
  std::string_view argument;     ///< What follows the name and a colon: "HOST:PORT", or "".
  std::string_view description;  ///< One phrase for people.
  /// Returns the device with its default settings, not opened, for a loop of this rate. Throws
  /// `core::Error` for an argument or a rate that it cannot use. Not real time.
  std::unique_ptr<HapticDevice> (*make)(std::string_view argument, double rate_hz);
  /// An optional argument, "OPTION,...", or "".
  std::string_view optional_argument;
};

/// Return the parts of a device's name before and after the first colon. Real time.
[[nodiscard]] std::string_view kind_of(std::string_view name) noexcept;
[[nodiscard]] std::string_view argument_of(std::string_view name) noexcept;

/// Returns one name for all spellings of a device: the whole path of a driver's file, 127.0.0.1
/// for localhost, and nothing from the first comma on, which says how a device is used and not
/// which one it is. Not real time.
[[nodiscard]] std::string canonical_name(std::string_view name);

/// Returns every device of this program; the first is the default.
[[nodiscard]] std::span<const DeviceEntry> devices() noexcept;

/// Returns the entry for "lumped" or "network:127.0.0.1:4700". Throws `core::Error` that lists
/// the existing names or says which argument is missing. Not real time.
[[nodiscard]] const DeviceEntry& device_named(std::string_view name);

/// Throws like `device_named` and the entry's `make`. Throws `DeviceUnreachable` for a device
/// that has to be asked for its capabilities and does not answer. Not real time.
[[nodiscard]] std::unique_ptr<HapticDevice> make_device(std::string_view name, double rate_hz);

class NetworkDevice;

/// What answers at "127.0.0.1:4700,key=robot", to look at what it says of itself: whether it is
/// a simulation is not compared with the options. Throws as `make_device`. Not real time.
[[nodiscard]] std::unique_ptr<NetworkDevice> asked_network_device(std::string_view argument);

}  // namespace jnd::device
