#include "device/registry/device_registry.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <system_error>

#include "core/error.h"
#include "core/for_people.h"
#include "device/exoskeleton/exoskeleton_device.h"
#include "device/exoskeleton/exoskeleton_options.h"
#include "device/lumped_hand_device.h"
#include "device/mouse_device.h"
#include "device/network/device_key.h"
#include "device/network/network_device.h"
#include "device/network/network_options.h"
#include "device/network/udp_port.h"
#include "device/plugin/plugin_device.h"
#include "device/plugin/plugin_options.h"
#include "device/twin/twin_device.h"
#include "device/unplugged_device.h"

namespace jnd::device {
namespace {

/// Returns the key for the device. On a network with other participants, the program does not
/// trust a device without a key, because it could not tell it from another.
std::optional<DeviceKey> key_for(const NetworkOptions& options, const Address& server) {
  if (!options.key_name.empty()) return read_device_key(device_key_file(options.key_name));
  if (is_loopback(server)) return std::nullopt;
  throw core::Error("device network " + text_of(server) +
                    ": expected a key, for others on that network could command the device or "
                    "answer for it; make one with `jnd device-key NAME`, copy its file to the "
                    "other machine and write HOST:PORT,key=NAME");
}

/// Throws unless the operator confirms the device's own statement that nobody can be hurt by
/// it, because that waives real time and arming.
void require_as_told(const NetworkDevice& device, const NetworkOptions& options,
                     const Address& server) {
  const std::string place = "device network " + text_of(server) + ": expected ";
  if (device.says_simulated() && !options.is_simulated) {
    throw core::Error(place + "a real device, found one that says it is simulated; write " +
                      text_of(server) + ",simulated if that is true, or " + text_of(server) +
                      ",real to use it as if it were not");
  }
  if (!device.says_simulated() && options.is_simulated.value_or(false)) {
    throw core::Error(place +
                      "a simulated device, as \",simulated\" says, found one that says it is "
                      "real; leave \",simulated\" away, or have its program say in the welcome "
                      "that nobody can be hurt by it");
  }
}

std::unique_ptr<NetworkDevice> unasked_network_device(const NetworkOptions& options,
                                                      const Address& server, double rate_hz) {
  std::random_device draw;
  return std::make_unique<NetworkDevice>(
      UdpPort::connected_to(server), server,
      NetworkDevice::Parameters{.rate_hz = rate_hz,
                                .token = std::uint64_t{draw()} << 32 | draw(),
                                .key = key_for(options, server),
                                .believes_simulated = options.is_simulated.value_or(false)});
}

/// Asked what it can do, unless there is no address: then it is there to be listed.
std::unique_ptr<HapticDevice> network_device(std::string_view argument, double rate_hz) {
  const NetworkOptions options =
      argument.empty() ? NetworkOptions{.endpoint = {.host = "127.0.0.1", .port = 1}}
                       : network_options(argument);
  const Address server = resolved(options.endpoint);
  std::unique_ptr<NetworkDevice> device = unasked_network_device(options, server, rate_hz);
  if (argument.empty()) return device;
  device->ask();
  require_as_told(*device, options, server);
  return device;
}

constexpr std::array kDevices = {
    DeviceEntry{.name = "lumped",
                .argument = "",
                .description =
                    core::for_people("a simulated hand: one mass drawn through the medium by a "
                                     "simulated arm"),
                .make = [](std::string_view, double rate_hz) -> std::unique_ptr<HapticDevice> {
                  return std::make_unique<LumpedHandDevice>(
                      LumpedHandDevice::Parameters{.rate_hz = rate_hz});
                }},
    DeviceEntry{
        .name = "exoskeleton",
        .argument = "",
        .description = core::for_people(
            "the simulated hand exoskeleton on its arm, 22 degrees of freedom, "
            "with a simulated hand on it"),
        .make = [](std::string_view options, double rate_hz) -> std::unique_ptr<HapticDevice> {
          ExoskeletonDevice::Parameters parameters = exoskeleton_parameters(options);
          parameters.rate_hz = rate_hz;
          return std::make_unique<ExoskeletonDevice>(parameters);
        },
        .optional_argument = kExoskeletonOptions},
    DeviceEntry{
        .name = "mouse",
        .argument = "",
        .description =
            core::for_people("a hand that a person draws with the mouse and sees lag behind, "
                             "for trying things out without a robot"),
        .make = [](std::string_view, double rate_hz) -> std::unique_ptr<HapticDevice> {
          return std::make_unique<MouseDevice>(MouseDevice::Parameters{.rate_hz = rate_hz});
        }},
    DeviceEntry{.name = "network",
                .argument = "HOST:PORT",
                .description = core::for_people(
                    "a device that another program serves, such as "
                    "`jnd device-simulator`; it says what it can do when asked; "
                    "behind the address key=NAME, simulated or real, with commas "
                    "between"),
                .make = network_device},
    DeviceEntry{.name = "plugin",
                .argument = "PATH",
                .description = core::for_people(
                    "a device by a driver of your own, a shared object with the "
                    "functions of jnd_device.h; behind the path and a colon "
                    "simulated or real, and KEY=VALUE for the driver, with commas "
                    "between"),
                .make = make_plugin_device},
    DeviceEntry{
        .name = "twin",
        .argument = "",
        .description =
            core::for_people("a simulated device with the faults of real ones (its own frame, "
                             "weight, friction, gain, delay), for measuring it: "
                             "`jnd commission`"),
        .make = [](std::string_view options, double rate_hz) -> std::unique_ptr<HapticDevice> {
          TwinDevice::Parameters parameters = twin_parameters(options);
          parameters.rate_hz = rate_hz;
          return std::make_unique<TwinDevice>(parameters);
        },
        .optional_argument = kTwinOptions},
    DeviceEntry{.name = "unplugged",
                .argument = "",
                .description = core::for_people(
                    "a device that never starts, to rehearse what happens then"),
                .make = [](std::string_view, double rate_hz) -> std::unique_ptr<HapticDevice> {
                  return std::make_unique<UnpluggedDevice>(rate_hz);
                }},
};

}  // namespace

std::string_view kind_of(std::string_view name) noexcept {
  return name.substr(0, name.find(':'));
}

std::string_view argument_of(std::string_view name) noexcept {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? std::string_view() : name.substr(colon + 1);
}

static std::filesystem::path whole_path(const std::string& driver) {
  std::filesystem::path file = driver;
  try {
    file = plugin_file(driver);
  } catch (const core::Error&) {
    // It is not there, and so is called by the place where it would be.
  }
  std::error_code error;
  const std::filesystem::path whole =
      std::filesystem::weakly_canonical(std::filesystem::absolute(file, error), error);
  return error ? file : whole;
}

std::string canonical_name(std::string_view name) {
  constexpr std::string_view kLocal = "localhost:";
  name = name.substr(0, name.find(','));
  const std::string_view kind = kind_of(name);
  const std::string_view argument = argument_of(name);
  if (kind == "network" && argument.starts_with(kLocal)) {
    return "network:127.0.0.1:" + std::string(argument.substr(kLocal.size()));
  }
  if (kind != "plugin" || argument.empty()) return std::string(name);
  const std::size_t colon = std::min(argument.find(':'), argument.size());
  return "plugin:" + whole_path(std::string(argument.substr(0, colon))).string() +
         std::string(argument.substr(colon));
}

std::unique_ptr<NetworkDevice> asked_network_device(std::string_view argument) {
  const NetworkOptions options = network_options(argument);
  constexpr double kUsualRate_hz = 1000.0;
  std::unique_ptr<NetworkDevice> device =
      unasked_network_device(options, resolved(options.endpoint), kUsualRate_hz);
  device->ask();
  return device;
}

std::span<const DeviceEntry> devices() noexcept { return kDevices; }

const DeviceEntry& device_named(std::string_view name) {
  const std::string_view kind = kind_of(name);
  std::string known;
  for (const DeviceEntry& entry : kDevices) {
    const std::string spelling =
        std::string(entry.name) +
        (entry.argument.empty() ? "" : ":" + std::string(entry.argument));
    if (entry.name == kind) {
      if (entry.argument.empty() == argument_of(name).empty()) return entry;
      if (!entry.optional_argument.empty()) return entry;
      throw core::Error("device: expected " + spelling + ", found " + std::string(name));
    }
    known += (known.empty() ? "" : ", ") + spelling;
  }
  throw core::Error("device: expected one of " + known + ", found " + std::string(name));
}

std::unique_ptr<HapticDevice> make_device(std::string_view name, double rate_hz) {
  return device_named(name).make(argument_of(name), rate_hz);
}

}  // namespace jnd::device
