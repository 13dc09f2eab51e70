#include "device/plugin/direct_plugin_device.h"

#include "core/error.h"

namespace jnd::device {

DirectPluginDevice::DirectPluginDevice(const std::filesystem::path& driver,
                                       const std::string& options, std::string place,
                                       double rate_hz, bool believes_simulated)
    : place_(std::move(place)), rate_hz_(rate_hz), believes_simulated_(believes_simulated) {
  try {
    session_ = std::make_unique<DriverSession>(driver, options, rate_hz);
    if (capabilities().paces_loop) {
      throw core::Error(
          "expected a driver that does not pace the loop where it has no process "
          "of its own, found one that does; leave in-process away");
    }
  } catch (const core::Error& error) {
    throw DeviceUnreachable(place_ + ": " + error.what());
  }
}

void DirectPluginDevice::open() {
  try {
    session_->open();
    fault_ = core::Fault::kNone;
  } catch (const core::Error& error) {
    throw DeviceUnreachable(place_ + ": " + error.what());
  }
}

bool DirectPluginDevice::read(core::HapticState& state) noexcept {
  jnd_device_state measured;
  fault_ = session_->read(measured);
  if (fault_ == core::Fault::kNone) {
    fault_ = checked_state(session_->description(), measured, state);
  }
  return fault_ == core::Fault::kNone;
}

bool DirectPluginDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  const core::Fault found = session_->write(force_on_hand_n);
  if (found != core::Fault::kNone) fault_ = found;
  return found == core::Fault::kNone;
}

}  // namespace jnd::device
