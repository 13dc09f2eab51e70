#pragma once

#include "core/error.h"
#include "device/haptic_device.h"

namespace jnd::device {

/// A simulated device that never starts. It lets people rehearse, with the whole program, what
/// a session reports and stores if cable or power is missing.
class UnpluggedDevice final : public HapticDevice {
 public:
  explicit UnpluggedDevice(double rate_hz) : rate_hz_(rate_hz) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "unplugged"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return {.rate_hz = rate_hz_,
            .max_force_per_point_n = 1.0,
            .max_total_force_n = 1.0,
            .simulated = true,
            .moves_by_itself = true};
  }
  /// Always throws.
  void open() override {
    throw core::Error(
        "unplugged: expected the device to answer, found nothing connected; check its cable, "
        "its "
        "power and its emergency stop, then try again");
  }
  [[nodiscard]] bool read(core::HapticState&) noexcept override { return false; }
  [[nodiscard]] bool write(const core::PointVectors&) noexcept override { return false; }
  void close() noexcept override {}
  void halt() noexcept override {}  ///< It never gives force.

 private:
  double rate_hz_;
};

}  // namespace jnd::device
