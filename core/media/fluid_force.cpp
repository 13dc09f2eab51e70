#include "core/media/fluid_force.h"

#include <algorithm>
#include <cmath>

#include "core/safety/force_distribution.h"

namespace jnd::core {
namespace {

constexpr double kBuoyancyDepthM = 0.03;

Eigen::Matrix3d ellipsoid_damping(const MediumAmounts& medium,
                                  const HapticState& state) noexcept {
  const Eigen::Vector3d along_axes(medium.ellipsoid_fingers_n_s_per_m,
                                   medium.ellipsoid_across_n_s_per_m,
                                   medium.ellipsoid_normal_n_s_per_m);
  const Eigen::Matrix3d axes = hand_axes(state.tip_position_m, state.attached);
  if (axes.col(2).squaredNorm() == 0.0) return along_axes.mean() * Eigen::Matrix3d::Identity();
  return axes * along_axes.asDiagonal() * axes.transpose();
}

/// Returns the lift for an amount of 1 and a hand speed of 1.
Eigen::Vector3d unit_lift(const ForceMap& map, const Eigen::Vector3d& normal,
                          double hand_speed_m_per_s, const Eigen::Vector3d& velocity_m_per_s,
                          double fade_speed_m_per_s) noexcept {
  const double speed = velocity_m_per_s.norm();
  if (speed == 0.0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d ahead = velocity_m_per_s / speed;
  const double sine = std::clamp(ahead.dot(normal), -1.0, 1.0);
  const Eigen::Vector3d aside = normal - sine * ahead;
  const double cosine = aside.norm();
  // Head on, lift has no side to point to, and the map gives none.
  if (!(cosine > 1e-9)) return Eigen::Vector3d::Zero();
  const double coefficient = map.at(std::asin(std::abs(sine)), hand_speed_m_per_s).lift;
  const double faded = coefficient * std::min(1.0, speed / fade_speed_m_per_s);
  Eigen::Vector3d lift = (sine > 0.0 ? -faded : faded) / cosine * aside;
  // This removes the component along the motion that rounding left.
  lift -= lift.dot(ahead) * ahead;
  return lift;
}

}  // namespace

void add_up_fluid_force(const MediumAmounts& medium, const ForceMap* map,
                        const HandMotion& motion, const ShareRatios& shares,
                        const HapticState& state, std::uint8_t immersed_bits,
                        double surface_z_m, double fade_speed_m_per_s,
                        PointVectors& force_on_hand_n) noexcept {
  distribute_drag(medium.drag_n(motion, map), shares, state, immersed_bits, fade_speed_m_per_s,
                  force_on_hand_n);
  const bool has_ellipsoid = medium.has_ellipsoid();
  const bool has_lift = medium.lift_kg_per_m != 0.0 && map != nullptr && map->has_lift();
  if (!has_ellipsoid && !has_lift && medium.buoyancy_n == 0.0) return;

  Eigen::Matrix3d damping = Eigen::Matrix3d::Zero();
  if (has_ellipsoid) damping = ellipsoid_damping(medium, state);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  if (has_lift) normal = hand_plane_normal(state.tip_position_m, state.attached);
  const double lift_n = medium.lift_kg_per_m * motion.speed_m_per_s * motion.speed_m_per_s;
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (!state.attached[i] || (immersed_bits >> i & 1) == 0) continue;
    const double share = shares[i];
    const Eigen::Vector3d& velocity = state.tip_velocity_m_per_s[i];
    if (has_ellipsoid) force_on_hand_n[i] -= share * (damping * velocity);
    if (has_lift) {
      force_on_hand_n[i] += (share * lift_n) * unit_lift(*map, normal, motion.speed_m_per_s,
                                                         velocity, fade_speed_m_per_s);
    }
    if (medium.buoyancy_n != 0.0) {
      const double depth_m = std::max(0.0, surface_z_m - state.tip_position_m[i].z());
      force_on_hand_n[i].z() +=
          share * medium.buoyancy_n * std::min(1.0, depth_m / kBuoyancyDepthM);
    }
  }
}

}  // namespace jnd::core
