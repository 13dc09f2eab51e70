#pragma once

#include <string>

#include "device/haptic_device.h"
#include "device/plugin/driver_session.h"

namespace jnd::device {

/// A driver in this process, which crashes with the driver. It serves to measure what a
/// separate process costs, with simulated devices alone. Any thread may call `halt`.
class DirectPluginDevice final : public HapticDevice {
 public:
  /// Throws `DeviceUnreachable`, with a message that begins with `place`. Not real time.
  DirectPluginDevice(const std::filesystem::path& driver, const std::string& options,
                     std::string place, double rate_hz, bool believes_simulated);

  [[nodiscard]] std::string_view name() const noexcept override { return "plugin"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return capabilities_of(session_->description(), rate_hz_, believes_simulated_);
  }
  [[nodiscard]] DeviceIdentity identity() const override {
    return identity_of(session_->description());
  }
  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override { session_->close(); }
  [[nodiscard]] core::Fault fault() const noexcept override { return fault_; }
  void halt() noexcept override { session_->halt(); }

 private:
  std::string place_;
  double rate_hz_;
  bool believes_simulated_;
  std::unique_ptr<DriverSession> session_;
  core::Fault fault_ = core::Fault::kNone;
};

}  // namespace jnd::device
