#pragma once

#include "device/drawn_mass.h"
#include "device/halt_latch.h"
#include "device/haptic_device.h"
#include "device/ordered_arm.h"
#include "device/stroking_arm.h"

namespace jnd::device {

/// A simulated hand on a simulated device: one `DrawnMass` that a `StrokingArm` pulls,
///
///   mass a = rendered force + arm force - viscosity v - friction v / sqrt(|v|^2 + v0^2).
///
/// The loop's thread uses it. One other thread may give orders to the `simulated_hand`.
class LumpedHandDevice final : public HapticDevice {
 public:
  struct Parameters {
    double rate_hz = 1000.0;                      ///< Rate of the loop that drives it, > 0.
    double mass_kg = 1.0;                         ///< Mass of hand and device together, > 0.
    double mechanical_viscosity_n_s_per_m = 0.0;  ///< Of the device, >= 0.
    double dry_friction_n = 0.0;                  ///< Of the device, >= 0.
    /// v0: around rest, within this speed, the friction force is smooth; > 0.
    double friction_speed_m_per_s = 0.01;
    StrokingArm::Parameters arm;
    double max_force_per_point_n = 10.0;  ///< > 0.
    double max_total_force_n = 30.0;      ///< > 0.
  };

  /// Throws `core::Error` naming the field, also if the period is too long for the combination
  /// of mass and damping. Not real time.
  explicit LumpedHandDevice(const Parameters& parameters);

  [[nodiscard]] std::string_view name() const noexcept override { return "lumped"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  /// Puts the hand at rest at home, with time and sums at 0.
  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override {}
  void halt() noexcept override { halt_.halt(); }
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override {
    return hand_.sums();
  }
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override { return &arm_; }

 private:
  Parameters parameters_;
  double period_s_;
  OrderedArm arm_;
  DrawnMass hand_;
  HaltLatch halt_;
};

}  // namespace jnd::device
