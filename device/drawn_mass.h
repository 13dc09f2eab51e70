#pragma once

#include <cmath>
#include <cstdint>

#include "core/contact_sums.h"
#include "core/haptic_state.h"

namespace jnd::device {

/// Positions of the tips relative to a simulated hand, in metres. The stiff hand has its
/// fingers along +y and its thumb up, all in the plane x = 0. The positions are multiples of
/// 0.1 um, the grid of a recording, with mean zero.
[[nodiscard]] inline const core::PointVectors& lumped_hand_tips_m() noexcept {
  static const core::PointVectors kTips = {
      Eigen::Vector3d(0.0, -0.061, 0.017), Eigen::Vector3d(0.0, -0.061, -0.043),
      Eigen::Vector3d(0.0, -0.001, 0.037), Eigen::Vector3d(0.0, 0.059, 0.007),
      Eigen::Vector3d(0.0, 0.064, -0.018)};
  return kTips;
}

/// What all simulated hands share: one mass that is pulled through the medium, with five tips
/// fixed to it. The hand plane's normal is along x, so a stroke along x meets the medium head
/// on. Its time advances by one period with each move, so a run is the same to the bit, however
/// fast it goes. Single-threaded; real time.
class DrawnMass {
 public:
  /// `rate_hz` > 0 and finite. Not real time.
  DrawnMass(double rate_hz, const Eigen::Vector3d& position_m) noexcept
      : period_s_(1.0 / rate_hz), period_ns_(std::llround(1e9 / rate_hz)) {
    rest_at(position_m);
    (void)lumped_hand_tips_m();  // The tips are computed here and not in the first tick.
  }

  /// Puts the hand there at rest, with time and sums at 0.
  void rest_at(const Eigen::Vector3d& position_m) noexcept {
    position_m_ = position_m;
    velocity_m_per_s_.setZero();
    device_time_ns_ = 0;
    sums_ = {};
  }

  void read(core::HapticState& state) const noexcept {
    const core::PointVectors& tips = lumped_hand_tips_m();
    state.device_time_ns = device_time_ns_;
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      state.tip_position_m[i] = position_m_ + tips[i];
      state.tip_velocity_m_per_s[i] = velocity_m_per_s_;
      state.attached[i] = true;
    }
    // The platform that carries the fingers is behind the hand.
    state.end_effector_position_m = position_m_ - Eigen::Vector3d(0.0, 0.12, 0.0);
  }

  /// Adds one tick to the sums: the rendered force, and the device's own damping at this speed.
  void feel(const Eigen::Vector3d& rendered_n, double damping_n_s_per_m) noexcept {
    const double speed_m_per_s = std::sqrt(velocity_m_per_s_.squaredNorm());
    const double rendered_opposing_n =
        speed_m_per_s > 0.0 ? -rendered_n.dot(velocity_m_per_s_) / speed_m_per_s : 0.0;
    ++sums_.num_ticks;
    sums_.rendered_opposing_n += rendered_opposing_n;
    sums_.opposing_n += rendered_opposing_n + damping_n_s_per_m * speed_m_per_s;
    sums_.speed_m_per_s += speed_m_per_s;
  }

  /// Sets the velocity and moves by it for one period (semi-implicit Euler).
  void move_at(const Eigen::Vector3d& velocity_m_per_s) noexcept {
    velocity_m_per_s_ = velocity_m_per_s;
    position_m_ += period_s_ * velocity_m_per_s_;
    device_time_ns_ += period_ns_;
  }

  [[nodiscard]] const Eigen::Vector3d& position_m() const noexcept { return position_m_; }
  [[nodiscard]] const Eigen::Vector3d& velocity_m_per_s() const noexcept {
    return velocity_m_per_s_;
  }
  [[nodiscard]] double period_s() const noexcept { return period_s_; }
  [[nodiscard]] const core::ContactSums& sums() const noexcept { return sums_; }

 private:
  double period_s_;
  std::int64_t period_ns_;
  Eigen::Vector3d position_m_;
  Eigen::Vector3d velocity_m_per_s_ = Eigen::Vector3d::Zero();
  std::int64_t device_time_ns_ = 0;
  core::ContactSums sums_;
};

/// Returns the sum of the forces at the points. Real time.
[[nodiscard]] inline Eigen::Vector3d total_of(const core::PointVectors& force_n) noexcept {
  Eigen::Vector3d total_n = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& force : force_n) total_n += force;
  return total_n;
}

}  // namespace jnd::device
