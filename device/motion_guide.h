#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/exchange/latest_value.h"
#include "device/guide.h"

namespace jnd::device {

/// A sine of amplitude 1 that passes every frequency below half the rate in this many ticks,
/// and then begins anew without a step; `num_ticks` is a multiple of 4. All frequencies that
/// have whole periods in it are there with much the same amplitude, and its peak is no more
/// than 1.4 of its root mean square (Schroeder 1970 gives such phases). Real time.
[[nodiscard]] double sweep_at(std::int64_t tick, int num_ticks) noexcept;

/// Guides every contact point of a device along one straight way after the other by a spring
/// and a damper, as told by another thread,
///
///     force = share (k (reference - position) + d (reference velocity - velocity) + pulse)
///             + sweep at one point,
///
/// where the whole reference moves at a constant speed or smoothly and then rests, where a
/// pulse is a square wave, one half of its period along a vector, the other half against it,
/// and where a sweep is a sine that rises from rest to half the rate of the loop in each of its
/// periods
/// (`sweep_at`). Everything is in the frame of the device that its loop drives.
class MotionGuide final : public Guide {
 public:
  /// What to do from the next tick on. Trivially copyable.
  struct Order {
    std::array<double, 3> to_m{};  ///< Of the mean of the points that the device has.
    double speed_m_per_s = 0.1;    ///< > 0; of a smooth way its mean.
    /// From rest to rest with the least jerk (Flash and Hogan 1985), so that nothing inside the
    /// device begins to sway; its highest speed is 1.875 of the mean.
    bool is_smooth = false;
    double stiffness_n_per_m = 0.0;   ///< Of all points together, >= 0; 0: no way.
    double damping_n_s_per_m = 0.0;   ///< Likewise.
    std::array<double, 3> pulse_n{};  ///< Of all points together.
    double pulse_period_s = 0.0;      ///< 0: no pulses.
    /// At point `sweep_point` along axis `sweep_axis`, over and over; 0 N: none.
    double sweep_n = 0.0;
    int sweep_ticks = 128;  ///< Of one sweep, a multiple of 4.
    int sweep_point = 0, sweep_axis = 0;
    /// Where the device is when the order is taken, the way begins, also if it was held
    /// elsewhere before: of one that somebody has moved meanwhile.
    bool begins_here = false;
    bool is_on = false;  ///< No force of the guide at all.
  };

  /// `shares`: of the device's points, as it declares them.
  explicit MotionGuide(const core::ShareRatios& shares) noexcept : shares_(shares) {}

  /// Any one thread.
  void order(const Order& order) noexcept { orders_.publish(order); }

  [[nodiscard]] core::PointVectors force_n(const core::HapticState& state,
                                           double period_s) noexcept override;

 private:
  /// To where it is due in the next tick; its speed.
  [[nodiscard]] Eigen::Vector3d move_reference(double period_s) noexcept;
  void take_order(const core::HapticState& state) noexcept;
  [[nodiscard]] Eigen::Vector3d mean_m(const core::HapticState& state) const noexcept;

  core::ShareRatios shares_;
  core::LatestValue<Order> orders_;
  bool has_reference_ = false;
  Eigen::Vector3d reference_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d begun_m_ = Eigen::Vector3d::Zero();  ///< Where it was when this order came.
  core::PointVectors from_mean_m_ = core::zero_vectors();  ///< Of each point.
  std::int64_t num_ticks_ = 0;                             ///< Of this order.
};

}  // namespace jnd::device
