#include "core/hand.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace jnd::core {

std::optional<ContactPoint> tip_of_hand_plane(
    const std::array<bool, kNumContactPoints>& attached) noexcept {
  const auto holds = [&](ContactPoint point) { return attached[static_cast<int>(point)]; };
  if (!holds(ContactPoint::kPalmInner) || !holds(ContactPoint::kPalmOuter)) return std::nullopt;
  for (const ContactPoint tip : {ContactPoint::kIndex, ContactPoint::kMiddle}) {
    if (holds(tip)) return tip;
  }
  return std::nullopt;
}

Eigen::Vector3d hand_plane_normal(
    const PointVectors& tip_position_m,
    const std::array<bool, kNumContactPoints>& attached) noexcept {
  const std::optional<ContactPoint> tip = tip_of_hand_plane(attached);
  if (!tip) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d& inner = tip_position_m[static_cast<int>(ContactPoint::kPalmInner)];
  const Eigen::Vector3d& outer = tip_position_m[static_cast<int>(ContactPoint::kPalmOuter)];
  const Eigen::Vector3d normal =
      (outer - inner).cross(tip_position_m[static_cast<int>(*tip)] - inner);
  const double length = normal.norm();
  if (!(length > 1e-12)) return Eigen::Vector3d::Zero();
  return normal / length;
}

HandMotion hand_motion(const PointVectors& tip_position_m,
                       const PointVectors& tip_velocity_m_per_s,
                       const std::array<bool, kNumContactPoints>& attached) noexcept {
  HandMotion motion;
  int num_attached = 0;
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (!attached[i]) continue;
    motion.velocity_m_per_s += tip_velocity_m_per_s[i];
    ++num_attached;
  }
  if (num_attached == 0) return motion;
  motion.velocity_m_per_s /= num_attached;
  motion.speed_m_per_s = motion.velocity_m_per_s.norm();
  if (motion.speed_m_per_s > 0.0) {
    const double along_normal =
        std::abs(motion.velocity_m_per_s.dot(hand_plane_normal(tip_position_m, attached)));
    motion.sin_angle_of_attack = std::min(along_normal / motion.speed_m_per_s, 1.0);
  }
  return motion;
}

}  // namespace jnd::core
