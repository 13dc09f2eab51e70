#pragma once

#include <array>
#include <cstdint>

#include "device/exoskeleton/kinematics.h"
#include "device/exoskeleton/mujoco_world.h"
#include "device/exoskeleton/torque_control.h"
#include "device/exoskeleton/velocity_filter.h"
#include "device/halt_latch.h"
#include "device/haptic_device.h"
#include "device/ordered_arm.h"
#include "device/ordered_bench.h"

namespace jnd::device {

/// The simulated exoskeleton on its arm, with a simulated person's hand on it:
///
///   read:  encoders -> velocity filter -> kinematics -> tips, end effector
///   write: forces -> extra delay -> torque control -> world, where a `StrokingArm` pulls
///
/// Its time advances by one period with each write. After `open` the same forces give the same
/// motion to the bit. A view draws the robot from the joints of `core::HapticState` alone,
/// which a real robot has as well, and the hand at its tips.
///
/// The loop's thread uses it. Another thread may call `halt` and give orders to the
/// `simulated_hand`.
class ExoskeletonDevice final : public HapticDevice {
 public:
  struct Parameters {
    double rate_hz = 1000.0;  ///< Rate of the loop that drives it, > 0.
    /// The person's arm. Its home is where hand and arm are at the start.
    StrokingArm::Parameters arm;
    TorqueControl::Parameters control;
    double velocity_cutoff_hz = 40.0;  ///< > 0.
    std::array<bool, core::kNumArmJoints> arm_joint_locked{};
    std::array<bool, core::kNumContactPoints> attached = core::kAllAttached;  ///< At `open`.
    double break_away_n = 25.0;           ///< Of each magnet, > 0.
    double extra_delay_s = 0.0;           ///< Delay of the force, in whole periods, [0, 0.02].
    std::uint64_t sensor_seed = 1;        ///< As in `MujocoWorld`.
    double max_force_per_point_n = 10.0;  ///< > 0.
    double max_total_force_n = 30.0;      ///< > 0.
  };

  /// Throws `core::Error` naming the field. Not real time.
  explicit ExoskeletonDevice(const Parameters& parameters);

  [[nodiscard]] std::string_view name() const noexcept override { return "exoskeleton"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  /// Puts the robot at rest in the neutral pose with the hand at home, and resets time, sums
  /// and faults.
  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  /// Refuses a force that is not finite. Then no motor gets a force until all forces are zero,
  /// as a loop with a fault writes them.
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override {}

  [[nodiscard]] core::Fault fault() const noexcept override;
  void halt() noexcept override { halt_.halt(); }
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override { return &arm_; }
  /// Without a hand, the device holds a dummy that hangs on a cord and carries the load.
  [[nodiscard]] Bench* bench() noexcept override { return &bench_; }
  /// The opposing force is all that the magnets do to the hand.
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override { return sums_; }

  /// Magnets and loads, see `MujocoWorld`. For the loop's thread. Real time.
  void detach(int point) noexcept { world_.detach(point); }
  void attach(int point) noexcept { world_.attach(point); }
  void load_tip(int point, const Eigen::Vector3d& force_n) noexcept {
    world_.load_tip(point, force_n);
  }
  [[nodiscard]] const MujocoWorld& world() const noexcept { return world_; }
  [[nodiscard]] const ExoskeletonKinematics& kinematics() const noexcept { return kinematics_; }

 private:
  static constexpr int kMaxDelayTicks = 64;

  void measure() noexcept;
  [[nodiscard]] core::PointVectors within_capabilities(
      const core::PointVectors& force_n) const noexcept;
  [[nodiscard]] const core::PointVectors& delayed(const core::PointVectors& force_n) noexcept;
  [[nodiscard]] Eigen::Vector3d pull_on_forearm_n() noexcept;
  void add_to_sums(const core::PointVectors& force_on_hand_n) noexcept;

  Parameters parameters_;
  double period_s_;
  std::int64_t period_ns_;
  int delay_ticks_;
  OrderedArm arm_;
  OrderedBench bench_;
  std::uint32_t last_hold_ = 0;
  /// Where the dummy is held or carried to.
  Eigen::Vector3d held_m_ = Eigen::Vector3d::Zero();
  ExoskeletonKinematics kinematics_;
  MujocoWorld world_;
  TorqueControl control_;
  VelocityFilter filter_;

  HaltLatch halt_;
  core::PointVectors acted_n_ = core::zero_vectors();  ///< Force in the last step.
  std::array<core::PointVectors, kMaxDelayTicks> delay_line_;
  int delay_slot_ = 0;
  std::int64_t device_time_ns_ = 0;
  TorqueControl::Measured measured_;
  core::PointVectors tip_velocity_m_per_s_ = core::zero_vectors();
  core::ContactSums sums_;
};

}  // namespace jnd::device
