#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace jnd::app {

/// What `device-simulator` and `device-server` share: a device served to
/// `--device network:HOST:PORT`.
struct DeviceServing {
  bool is_simulator = false;  ///< Nothing but a simulated device is served.
  int port = 4700;
  std::string device;
  std::string listen = "127.0.0.1";
  std::string key;                 ///< Name of a key; "": none.
  std::vector<std::string> allow;  ///< Hosts; none: any.
  double rate_hz = 1000.0;
  double seconds = 0.0;  ///< 0: until it is told to stop.
  bool releases_stop = false;
  bool json = false;
};

/// All options but that of the device.
void add_serving_options(CLI::App& command, DeviceServing& options);

/// Serves it until it is told to stop. The exit code; throws `UsageError`, `EnvironmentError`.
[[nodiscard]] int serve_device(const DeviceServing& options);

}  // namespace jnd::app
