#pragma once

#include <cmath>
#include <numbers>

#include "core/require.h"
#include "device/exoskeleton/geometry.h"

namespace jnd::device {

/// Computes the velocities of joints from their encoders, by differences over one period and a
/// low-pass of first order,
///
///   v += (1 - exp(-2 pi cutoff period)) ((position - last position) / period - v),
///
/// which lags by 1 / (2 pi cutoff) behind a steady acceleration. Real time except the
/// constructor.
class VelocityFilter {
 public:
  /// Throws `core::Error` unless both are finite and > 0. Not real time.
  VelocityFilter(double cutoff_hz, double period_s) : period_s_(period_s) {
    core::require_positive(cutoff_hz, "cutoff_hz");
    core::require_positive(period_s, "period_s");
    weight_ratio_ = 1.0 - std::exp(-2.0 * std::numbers::pi * cutoff_hz * period_s);
  }

  /// Starts at rest at this position.
  void start(const JointVector& position_rad) noexcept {
    position_rad_ = position_rad;
    velocity_rad_per_s_.setZero();
  }

  /// Takes the positions one period later. A joint whose encoder gave a value that is not a
  /// number starts again at rest with the next number.
  const JointVector& update(const JointVector& position_rad) noexcept {
    const auto lost = !(position_rad_ + velocity_rad_per_s_).array().isFinite();
    if (lost.any()) {
      position_rad_ = lost.select(position_rad, position_rad_);
      velocity_rad_per_s_ = lost.select(0.0, velocity_rad_per_s_);
    }
    velocity_rad_per_s_ +=
        weight_ratio_ * ((position_rad - position_rad_) / period_s_ - velocity_rad_per_s_);
    position_rad_ = position_rad;
    return velocity_rad_per_s_;
  }

  [[nodiscard]] const JointVector& velocity_rad_per_s() const noexcept {
    return velocity_rad_per_s_;
  }

 private:
  double period_s_;
  double weight_ratio_ = 1.0;
  JointVector position_rad_ = JointVector::Zero();
  JointVector velocity_rad_per_s_ = JointVector::Zero();
};

}  // namespace jnd::device
