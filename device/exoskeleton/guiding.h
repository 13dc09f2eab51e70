#pragma once

#include <Eigen/Core>

namespace jnd::device {

/// The hand of somebody who carries a thing to its place: a spring and a damper with a limited
/// strength. It serves for forces in N and m as well as for torques in N m and rad.
struct Guiding {
  double stiffness;
  double damping;
  double strength;

  /// `gap` is the remaining distance, `speed` the velocity of the thing relative to its
  /// destination. Real time.
  [[nodiscard]] Eigen::Vector3d effort(const Eigen::Vector3d& gap,
                                       const Eigen::Vector3d& speed) const noexcept {
    const Eigen::Vector3d wanted = stiffness * gap - damping * speed;
    const double size = wanted.norm();
    return size > strength ? Eigen::Vector3d(wanted * (strength / size)) : wanted;
  }
};

}  // namespace jnd::device
