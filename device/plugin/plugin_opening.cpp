#include <string>

#include "core/error.h"
#include "device/plugin/direct_plugin_device.h"
#include "device/plugin/plugin_device.h"
#include "device/plugin/plugin_options.h"

// From a name on the command line to a device.

namespace jnd::device {
namespace {

/// Stands for the plug-in devices where `jnd devices` lists them and no driver is named. It
/// cannot be used.
class UnnamedPlugin final : public HapticDevice {
 public:
  explicit UnnamedPlugin(double rate_hz) : rate_hz_(rate_hz) {}
  [[nodiscard]] std::string_view name() const noexcept override { return "plugin"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return {.rate_hz = rate_hz_, .has_own_clock = true};
  }
  void open() override {
    throw DeviceUnreachable("device plugin: expected the path of a driver, found none");
  }
  [[nodiscard]] bool read(core::HapticState&) noexcept override { return false; }
  [[nodiscard]] bool write(const core::PointVectors&) noexcept override { return false; }
  void close() noexcept override {}
  void halt() noexcept override {}

 private:
  double rate_hz_;
};

/// Throws unless the operator confirms the driver's statement that nobody can be hurt, because
/// that waives real time and arming.
void require_as_told(bool driver_says_simulated, const PluginOptions& options,
                     const std::string& place) {
  if (driver_says_simulated && !options.says_simulated && !options.says_real) {
    throw core::Error(place +
                      ": expected a real device, found one that says it is simulated; write "
                      "plugin:" +
                      options.name + ":simulated if that is true, or plugin:" + options.name +
                      ":real to use it as if it were not");
  }
  if (!driver_says_simulated && options.says_simulated) {
    throw core::Error(
        place +
        ": expected a simulated device, as \"simulated\" says, found one that says "
        "it is real; leave \"simulated\" away, or set JND_DEVICE_IS_SIMULATED in "
        "its description if nobody can be hurt by it");
  }
  if (options.in_process && !options.says_simulated) {
    throw core::Error(place +
                      ": expected a simulated device where the driver has no process of its "
                      "own, found a real one; leave in-process away");
  }
}

std::string place_of(const std::filesystem::path& driver) {
  return "device plugin " + driver.string();
}

DriverProcess::Parameters process_of(const PluginOptions& options,
                                     const std::filesystem::path& driver, double rate_hz) {
  return {.host = device_host_file(),
          .driver = driver,
          .options = options.of_driver,
          .place = place_of(driver),
          .rate_hz = rate_hz};
}

}  // namespace

jnd_device_description described_plugin(std::string_view argument) {
  const PluginOptions options = plugin_options(argument);
  return DriverProcess(process_of(options, plugin_file(options.name), 1000.0)).describe();
}

std::unique_ptr<HapticDevice> make_plugin_device(std::string_view argument, double rate_hz) {
  if (argument.empty()) return std::make_unique<UnnamedPlugin>(rate_hz);
  const PluginOptions options = plugin_options(argument);
  const std::filesystem::path driver = plugin_file(options.name);
  const std::string place = place_of(driver);
  if (options.in_process) {
    // This check comes before anything of the driver is loaded.
    require_as_told(options.says_simulated, options, place);
    auto device = std::make_unique<DirectPluginDevice>(driver, options.of_driver, place,
                                                       rate_hz, options.says_simulated);
    require_as_told(device->capabilities().simulated, options, place);
    return device;
  }
  auto device = std::make_unique<PluginDevice>(
      PluginDevice::Parameters{.process = process_of(options, driver, rate_hz),
                               .believes_simulated = options.says_simulated});
  require_as_told((device->description().flags & JND_DEVICE_IS_SIMULATED) != 0, options, place);
  return device;
}

}  // namespace jnd::device
