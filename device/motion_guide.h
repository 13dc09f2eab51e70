#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/exchange/latest_value.h"
#include "device/guide.h"

namespace jnd::device {

/// Returns a sine of amplitude 1 that passes through every frequency below half the rate in
/// this many ticks, and then repeats without a step. `num_ticks` is a multiple of 4. It
/// contains all frequencies of whole periods with similar amplitudes, and its peak is at most
/// 1.4 times its root mean square (Schroeder 1970 gives such phases). Real time.
[[nodiscard]] double sweep_at(std::int64_t tick, int num_ticks) noexcept;

/// Guides every contact point of a device along straight paths, by a spring and a damper, as
/// another thread orders,
///
///   force = share (k (reference - position) + d (reference velocity - velocity) + pulse) +
///   sweep at one point.
///
/// The reference moves at a constant speed or smoothly, and then rests. A pulse is a square
/// wave along a vector. A sweep is a sine that rises from rest to half the rate of the loop in
/// each of its periods (`sweep_at`). Everything is in the frame of the device that the loop
/// drives.
class MotionGuide final : public Guide {
 public:
  /// What to do from the next tick on. Trivially copyable.
  struct Order {
    std::array<double, 3> to_m{};  ///< Target of the mean of the points that the device has.
    double speed_m_per_s = 0.1;    ///< > 0; on a smooth path the mean speed.
    /// The path goes from rest to rest with the least jerk (Flash and Hogan 1985), so that
    /// nothing inside of the device begins to swing. The highest speed is 1.875 times the mean.
    bool is_smooth = false;
    double stiffness_n_per_m = 0.0;   ///< Of all points together, >= 0; 0 for no path.
    double damping_n_s_per_m = 0.0;   ///< Of all points together, >= 0.
    std::array<double, 3> pulse_n{};  ///< Of all points together.
    double pulse_period_s = 0.0;      ///< 0 for no pulses.
    /// Amplitude at point `sweep_point` along axis `sweep_axis`, repeated for ever; 0 N for
    /// none.
    double sweep_n = 0.0;
    int sweep_ticks = 128;  ///< Duration of one sweep, a multiple of 4.
    int sweep_point = 0, sweep_axis = 0;
    /// Where the device is when the order is taken, the way begins, also if it was held
    /// elsewhere before: of one that somebody has moved meanwhile.
    bool begins_here = false;
    bool is_on = false;  ///< No force of the guide at all.
  };

  /// `shares` are those of the device's points.
  explicit MotionGuide(const core::ShareRatios& shares) noexcept : shares_(shares) {}

  /// Any one thread may call it.
  void order(const Order& order) noexcept { orders_.publish(order); }

  [[nodiscard]] core::PointVectors force_n(const core::HapticState& state,
                                           double period_s) noexcept override;

 private:
  /// Moves the reference to its place in the next tick and returns its velocity.
  [[nodiscard]] Eigen::Vector3d move_reference(double period_s) noexcept;
  void take_order(const core::HapticState& state) noexcept;
  [[nodiscard]] Eigen::Vector3d mean_m(const core::HapticState& state) const noexcept;

  core::ShareRatios shares_;
  core::LatestValue<Order> orders_;
  bool has_reference_ = false;
  Eigen::Vector3d reference_m_ = Eigen::Vector3d::Zero();
  /// Place of the reference when this order came.
  Eigen::Vector3d begun_m_ = Eigen::Vector3d::Zero();
  /// Offset of each point from the mean.
  core::PointVectors from_mean_m_ = core::zero_vectors();
  std::int64_t num_ticks_ = 0;  ///< Since this order came.
};

}  // namespace jnd::device
