#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "device/network/udp_port.h"

namespace jnd::device {

/// What stands behind "network:" on a command line, as in
/// `10.0.0.2:4700,key=robot` or `127.0.0.1:4700,simulated`.
struct NetworkOptions {
  Endpoint endpoint;
  /// Whether nobody can be hurt by the device, where the operator says so: `simulated` or
  /// `real`.
  std::optional<bool> is_simulated;
  std::string key_name;  ///< Of a key of `jnd device-key`; "": none.
};

/// Throws `core::Error` saying what was expected. Not real time.
[[nodiscard]] NetworkOptions network_options(std::string_view argument);

}  // namespace jnd::device
