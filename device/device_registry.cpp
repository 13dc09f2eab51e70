#include "device/device_registry.h"

#include <array>
#include <string>

#include "core/error.h"
#include "device/lumped_hand_device.h"
#include "device/mouse_device.h"
#include "device/unplugged_device.h"

namespace jnd::device {
namespace {

constexpr std::array kDevices = {
    DeviceEntry{.name = "lumped",
                .description = "a simulated hand: one mass drawn through the medium by a "
                               "simulated arm",
                .make = [](double rate_hz) -> std::unique_ptr<HapticDevice> {
                  return std::make_unique<LumpedHandDevice>(
                      LumpedHandDevice::Parameters{.rate_hz = rate_hz});
                }},
    DeviceEntry{.name = "mouse",
                .description = "a hand that a person draws with the mouse and sees lag behind, "
                               "for trying things out without a robot",
                .make = [](double rate_hz) -> std::unique_ptr<HapticDevice> {
                  return std::make_unique<MouseDevice>(
                      MouseDevice::Parameters{.rate_hz = rate_hz});
                }},
    DeviceEntry{.name = "unplugged",
                .description = "a device that never starts, to rehearse what happens then",
                .make = [](double rate_hz) -> std::unique_ptr<HapticDevice> {
                  return std::make_unique<UnpluggedDevice>(rate_hz);
                }},
};

}  // namespace

std::span<const DeviceEntry> devices() noexcept { return kDevices; }

const DeviceEntry& device_named(std::string_view name) {
  std::string known;
  for (const DeviceEntry& entry : kDevices) {
    if (entry.name == name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw core::Error("device: expected one of " + known + ", found " + std::string(name));
}

}  // namespace jnd::device
