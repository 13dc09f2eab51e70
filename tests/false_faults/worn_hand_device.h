#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "core/random_stream.h"
#include "device/halt_latch.h"
#include "device/haptic_device.h"
#include "device/stroking_arm.h"

namespace jnd::false_faults {

/// The properties of one person's hand and of the device on it. All of them are everyday in a
/// laboratory: nothing is wrong with hand or device.
struct Wear {
  double mass_kg = 1.0;         ///< Of hand and device together.
  double stiction_n = 0.6;      ///< Coulomb's friction, which also holds a hand at rest.
  double resolution_m = 20e-6;  ///< Step of the positions, as encoders give them.
  double filter_hz = 40.0;      ///< Cutoff of the first-order filter of the velocity.
  double tremor_m = 100e-6;     ///< Amplitude by which a free hand would shake.
  double tremor_hz = 10.0;
  /// Greatest shift of the time of a measurement, in either direction.
  double jitter_s = 100e-6;
  double lost_ratio = 0.01;  ///< Share of the measurements that do not come.
  int delay_ticks = 1;       ///< From a command to its force.
  /// How often a finger slides some millimetres in its holder.
  double slips_per_s = 1.0 / 20.0;
  double comes_off_per_s = 1.0 / 1200.0;

  /// Draws the properties of person number `person` evenly over what is met in laboratories.
  [[nodiscard]] static Wear of_person(std::uint64_t seed, std::int64_t person);
};

/// A healthy hand on a healthy device. A real device would measure it like this: quantised,
/// filtered, late, jittered and now and then lost. The hand is held by friction, trembles and
/// slides in its holders. It says that somebody can be hurt by it, so that everything that
/// watches over a real hand watches over this one.
class WornHandDevice final : public device::HapticDevice {
 public:
  WornHandDevice(const Wear& wear, std::uint64_t seed, std::int64_t person);

  [[nodiscard]] std::string_view name() const noexcept override { return "worn_hand"; }
  [[nodiscard]] device::DeviceCapabilities capabilities() const noexcept override {
    return {.tells_acting_force = true};
  }
  void open() override {}
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override {}
  void halt() noexcept override { halt_.halt(); }

  /// The arm, which does what the person does.
  [[nodiscard]] device::StrokingArm& arm() noexcept { return arm_; }
  /// How often a point has come off so far.
  [[nodiscard]] int num_detachments() const noexcept { return num_detachments_; }
  [[nodiscard]] const Eigen::Vector3d& position_m() const noexcept { return position_m_; }

 private:
  static constexpr double kPeriod_s = 0.001;
  static constexpr int kMostDelayTicks = 8;

  [[nodiscard]] Eigen::Vector3d tremor_n() const noexcept;
  void move(const Eigen::Vector3d& force_n) noexcept;
  void slide_fingers() noexcept;
  void measure() noexcept;

  Wear wear_;
  core::RandomStream random_;
  device::StrokingArm arm_;
  device::HaltLatch halt_;
  Eigen::Vector3d position_m_{0.0, 0.0, -0.15};
  Eigen::Vector3d velocity_m_per_s_ = Eigen::Vector3d::Zero();
  std::int64_t tick_ = 0;
  double filter_ratio_;
  std::array<core::PointVectors, kMostDelayTicks> sent_;

  struct Finger {
    /// Offset from the tip's place on a stiff hand.
    Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
    /// The way that is left to slide in the holder.
    Eigen::Vector3d slide_m = Eigen::Vector3d::Zero();
    int sliding_ticks = 0;
    int loose_ticks = 0;
  };
  std::array<Finger, core::kNumContactPoints> fingers_;
  int num_detachments_ = 0;

  core::PointVectors acted_sum_n_ = core::zero_vectors();  ///< Sum since the last measurement.
  int num_acted_ = 0;
  core::HapticState state_;           ///< The state that was measured in the last tick.
  core::HapticState last_delivered_;  ///< The state that was read last.
  bool has_delivered_ = false;
};

}  // namespace jnd::false_faults
