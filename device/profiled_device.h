#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "device/haptic_device.h"

namespace jnd::device {

/// Any device, as it was measured: what it measures comes in the workspace frame, forces go to
/// it in its own, and it is asked for no more than it was found to do. Gain and weight are not
/// corrected for: what was sent is what the study says, and its analysis knows better.
///
/// workspace position = rotation * robot position + offset; velocities, forces and torques are
/// turned, and a force on the hand is turned back before it is written. A number that is none
/// stays none. An end effector at exactly 0, 0, 0 is one that the device has not, and stays
/// there, as do points that it does not have. A simulated hand takes its orders in the
/// workspace frame. Real time where the device is; owns the device or borrows it.
class ProfiledDevice final : public HapticDevice {
 public:
  struct Parameters {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< Orthonormal, determinant 1.
    Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
    // What it is asked for at most, where it does not ask for less itself. > 0.
    double max_force_per_point_n = core::kInfinity;
    double max_total_force_n = core::kInfinity;
    double max_slew_n_per_s = core::kInfinity;
    double max_speed_m_per_s = core::kInfinity;
    /// In the workspace frame. It takes the place of what the device says of its space, which
    /// is in its own frame: that is kept to by no more than the box that holds it.
    core::Workspace workspace{core::kInfinity, core::kInfinity, core::kInfinity};
    // In the place of what it says of itself, where measured. >= 0.
    std::optional<double> own_mass_kg, own_damping_n_s_per_m, closed_loop_delay_s;
  };

  /// Throw `core::Error` naming the field that is out of range. Not real time.
  ProfiledDevice(std::unique_ptr<HapticDevice> inner, const Parameters& parameters);
  /// `inner` has to outlive this.
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
  [[nodiscard]] bool may_arm() const noexcept override { return inner_.may_arm(); }
  void halt() noexcept override { inner_.halt(); }
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override {
    return inner_.simulated_hand();
  }
  /// Marks are in the workspace on either side.
  [[nodiscard]] Bench* bench() noexcept override { return inner_.bench(); }
  [[nodiscard]] std::optional<LinkReport> link() const noexcept override {
    return inner_.link();
  }
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override {
    return inner_.contact_sums();
  }

 private:
  std::unique_ptr<HapticDevice> owned_;  ///< nullptr: borrowed.
  HapticDevice& inner_;
  Parameters parameters_;
  Eigen::Quaterniond turn_;  ///< The rotation.
};

}  // namespace jnd::device
