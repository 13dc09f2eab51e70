#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/contact_sums.h"
#include "core/random_stream.h"
#include "device/halt_latch.h"
#include "device/haptic_device.h"
#include "device/ordered_arm.h"
#include "device/ordered_bench.h"

namespace jnd::device {

/// A simulated device with the faults of real devices, which only this class knows: its own
/// frame, mass, damping and dry friction, a weight that it does not carry, a wrong force gain,
/// cogging, a delay, and noise. It is a stiff hand of five points on one mass,
///
///   mass a = gain u(t - delay) + weight + load + cogging(x) - damping v - friction + arm,
///
/// with dry friction that holds it at rest (Coulomb), computed in steps of 0.1 ms. Its
/// measurements are in its own frame: workspace = rotation * own + offset.
///
/// Either a simulated person's hand is in it, as in a session, or somebody measures it: the
/// hand is out from `Bench::take_hand_out` on. The loop's thread uses it. One other thread may
/// use bench and hand.
class TwinDevice final : public HapticDevice {
 public:
  struct Parameters {
    double rate_hz = 1000.0;  ///< Rate of the loop that drives it, > 0.
    std::string serial = "ideal";
    double mass_kg = 0.5;            ///< Of the device itself, >= 0.1.
    double hand_mass_kg = 0.5;       ///< Of the hand in it, >= 0.
    double damping_n_s_per_m = 0.0;  ///< >= 0.
    double friction_n = 0.0;         ///< >= 0.
    double weight_n = 0.0;           ///< Weight, downwards, that its motors do not carry.
    double gain = 1.0;               ///< Given force over requested force, > 0.
    double cogging_n = 0.0;          ///< Amplitude along each axis, >= 0.
    double delay_s = 0.0;            ///< Time from a write until its force acts, [0, 0.02].
    /// Rotation from the device's frame to the workspace.
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
    double position_sd_m = 0.0;          ///< >= 0.
    double position_resolution_m = 0.0;  ///< 0 for none.
    double velocity_sd_m_per_s = 0.0;    ///< >= 0.
    double touch_sd_m = 0.0;  ///< Error with which somebody meets a mark, on each axis, >= 0.
    /// Error with which it finds its zero again, on each axis, >= 0.
    double homing_sd_m = 0.0;
    std::uint64_t noise_seed = 1;
    StrokingArm::Parameters arm;
    double max_force_per_point_n = 10.0;  ///< > 0.
    double max_total_force_n = 30.0;      ///< > 0.
  };

  /// Throws `core::Error` naming the field. Not real time.
  explicit TwinDevice(const Parameters& parameters);

  [[nodiscard]] std::string_view name() const noexcept override { return "twin"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override;
  [[nodiscard]] DeviceIdentity identity() const override {
    return {.model = "jnd twin", .serial = parameters_.serial, .firmware = "1"};
  }
  /// Puts it at rest at home with the hand in it, with time and sums at 0.
  void open() override;
  [[nodiscard]] bool read(core::HapticState& state) noexcept override;
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override;
  void close() noexcept override {}
  void halt() noexcept override { halt_.halt(); }
  [[nodiscard]] core::ContactSums contact_sums() const noexcept override { return sums_; }
  [[nodiscard]] SimulatedHand* simulated_hand() noexcept override { return &arm_; }
  [[nodiscard]] Bench* bench() noexcept override { return &bench_; }

  /// Only tests may look at these.
  [[nodiscard]] const Parameters& made_with() const noexcept { return parameters_; }

 private:
  /// Returns the force that acts at this time after `open`, given all writes until then.
  [[nodiscard]] const core::PointVectors& acting_n(double time_s) const noexcept;
  [[nodiscard]] Eigen::Vector3d cogging_n() const noexcept;
  [[nodiscard]] Eigen::Vector3d noise(double sd) noexcept;
  void move(const BenchState& done, const Eigen::Vector3d& force_n) noexcept;
  void feel(const Eigen::Vector3d& rendered_n) noexcept;

  /// Duration of a step of motion. The ring is long enough for the longest delay at 10 kHz.
  static constexpr double kStep_s = 1e-4;
  static constexpr std::size_t kNumWrites = 256;

  Parameters parameters_;
  double period_s_;
  std::int64_t period_ns_;
  int num_steps_;  ///< Steps in a period.
  OrderedArm arm_;
  HaltLatch halt_;
  OrderedBench bench_;
  std::int64_t num_writes_ = 0;
  std::array<core::PointVectors, kNumWrites> written_n_;  ///< In the workspace frame.
  /// In the workspace frame, as the device believes.
  core::PointVectors acted_n_ = core::zero_vectors();
  Eigen::Vector3d position_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_per_s_ = Eigen::Vector3d::Zero();
  core::ContactSums sums_;
  core::RandomStream noise_;
  std::uint32_t last_hold_ = 0;
  std::uint32_t last_homing_ = 0;
  Eigen::Vector3d homed_m_ = Eigen::Vector3d::Zero();  ///< Error of its zero.
  Eigen::Vector3d touched_m_ = Eigen::Vector3d::Zero();
};

/// Reads what follows `twin:`, such as "seed=7,gain=0.9". `seed` draws a device with faults.
/// Each other key sets one fault, which makes it another device. But "drifted_gain_ratio",
/// "added_damping_n_s_per_m" and "turned_rad" change the same device, as if after its
/// measurement. Throws `core::Error` naming the problem. Not real time.
[[nodiscard]] TwinDevice::Parameters twin_parameters(std::string_view options);

/// Draws everything about a badly made device.
[[nodiscard]] TwinDevice::Parameters drawn_twin(std::uint64_t seed);

inline constexpr std::string_view kTwinOptions =
    "seed=N,mass_kg=X,damping_n_s_per_m=X,friction_n=X,weight_n=X,gain=X,delay_s=X,"
    "drifted_gain_ratio=X,added_damping_n_s_per_m=X,turned_rad=X";

}  // namespace jnd::device
