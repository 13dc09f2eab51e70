#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace jnd::app {

/// What `device-simulator` and `device-server` share: a device that is served to `--device
/// network:HOST:PORT`.
struct DeviceServing {
  bool is_simulator = false;  ///< Only simulated devices are served.
  int port = 4700;
  std::string device;
  std::string listen = "127.0.0.1";
  std::string key;                 ///< The name of a key; "" for none.
  std::vector<std::string> allow;  ///< The hosts that may connect; empty for any.
  double rate_hz = 1000.0;
  double seconds = 0.0;  ///< 0: until it is told to stop.
  bool releases_stop = false;
  bool json = false;
};

/// Adds all options except the one that names the device.
void add_serving_options(CLI::App& command, DeviceServing& options);

/// Serves the device until it is told to stop, and returns the exit code. Throws `UsageError`
/// and `EnvironmentError`.
[[nodiscard]] int serve_device(const DeviceServing& options);

}  // namespace jnd::app
