#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "device/haptic_device.h"

namespace jnd::device {

/// Any device with its measured profile. Its measurements are converted to the workspace frame,
/// forces are converted to its own frame, and it never gets more than it was found to do. Gain
/// and weight are not corrected: the sent force stays that of the study, and the analysis
/// accounts for them.
///
/// workspace position = rotation * robot position + offset. Velocities, forces and torques are
/// rotated, and a force on the hand is rotated back before it is written. A NaN stays NaN. An
/// end effector or point at exactly 0, 0, 0 is one that the device lacks, and stays there. A
/// simulated hand takes its orders in the workspace frame. Real time if the device is. It owns
/// the device or borrows it.
class ProfiledDevice final : public HapticDevice {
 public:
  struct Parameters {
    /// Orthonormal, with determinant 1.
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
    // Limits of what the device gets, unless its own are lower. > 0.
    double max_force_per_point_n = core::kInfinity;
    double max_total_force_n = core::kInfinity;
    double max_slew_n_per_s = core::kInfinity;
    double max_speed_m_per_s = core::kInfinity;
    /// In the workspace frame. It replaces the space that the device itself reports. That space
    /// is in the device's own frame, so only the box that holds it is respected.
    core::Workspace workspace{core::kInfinity, core::kInfinity, core::kInfinity};
    // If measured, these replace what the device reports. >= 0.
    std::optional<double> own_mass_kg, own_damping_n_s_per_m, closed_loop_delay_s;
  };

  /// Throws `core::Error` naming the field that is out of range. Not real time.
  ProfiledDevice(std::unique_ptr<HapticDevice> inner, const Parameters& parameters);
  /// Does the same with a borrowed device. `inner` must outlive this object.
  ProfiledDevice(HapticDevice& inner, const Parameters& parameters);

  [[nodiscard]] std::string_view name() const noexcept override { return inner_.name(); }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  [[nodiscard]] DeviceIdentity identity() const override { return inner_.identity(); }
  void open() override { inner_.open(); }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool wait_for_sample(std::int64_t deadline_ns) noexcept override {
    return inner_.wait_for_sample(deadline_ns);
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override { inner_.close(); }
  [[nodiscard]] core::Fault fault() const noexcept override { return inner_.fault(); }
  [[nodiscard]] std::string words_of_fault() const override { return inner_.words_of_fault(); }
  [[nodiscard]] bool answers() const override { return inner_.answers(); }
  [[nodiscard]] bool may_arm() const noexcept override { return inner_.may_arm(); }
  void halt() noexcept override { inner_.halt(); }
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override {
    return inner_.simulated_hand();
  }
  /// Marks are in the workspace frame on both sides.
  [[nodiscard]] Bench* bench() noexcept override { return inner_.bench(); }
  [[nodiscard]] std::optional<LinkReport> link() const noexcept override {
    return inner_.link();
  }
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override {
    return inner_.contact_sums();
  }

 private:
  std::unique_ptr<HapticDevice> owned_;  ///< nullptr if the device is borrowed.
  HapticDevice& inner_;
  Parameters parameters_;
  Eigen::Quaterniond turn_;  ///< `rotation` as a quaternion.
};

}  // namespace jnd::device
