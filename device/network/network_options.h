#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "device/network/udp_port.h"

namespace jnd::device {

/// What follows "network:" on a command line, as in `10.0.0.2:4700,key=robot` or
/// `127.0.0.1:4700,simulated`.
struct NetworkOptions {
  Endpoint endpoint;
  /// Whether the operator says that nobody can be hurt by the device: `simulated` or `real`.
  /// None if neither is given.
  std::optional<bool> is_simulated;
  std::string key_name;  ///< Name of a key of `jnd device-key`; "" for none.
};

/// Throws `core::Error` that says what was expected. Not real time.
[[nodiscard]] NetworkOptions network_options(std::string_view argument);

}  // namespace jnd::device
