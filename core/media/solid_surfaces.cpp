#include "core/media/solid_surfaces.h"

#include <algorithm>
#include <cmath>

namespace jnd::core {
namespace {

bool is_same(const Immersion& left, const Immersion& right) noexcept {
  return left.radius_m == right.radius_m && left.depth_m == right.depth_m &&
         left.origin_x_m == right.origin_x_m && left.origin_y_m == right.origin_y_m &&
         left.origin_z_m == right.origin_z_m;
}

SolidAmounts share_of(const SolidAmounts& amounts, double share) noexcept {
  return {share * amounts.stiffness_n_per_m, share * amounts.damping_n_s_per_m,
          share * amounts.friction_n_per_m};
}

Eigen::Vector3d from_axis(const Immersion& immersion, const Eigen::Vector3d& point_m) noexcept {
  return {point_m.x() - immersion.origin_x_m, point_m.y() - immersion.origin_y_m, 0.0};
}

double plane_depth_m(const Immersion& immersion, const Eigen::Vector3d& point_m) noexcept {
  return immersion.origin_z_m - point_m.z();
}

double wall_depth_m(const Immersion& immersion, const Eigen::Vector3d& point_m) noexcept {
  return from_axis(immersion, point_m).norm() - immersion.radius_m;
}

double bottom_depth_m(const Immersion& immersion, const Eigen::Vector3d& point_m) noexcept {
  return immersion.origin_z_m - immersion.depth_m - point_m.z();
}

}  // namespace

void SolidSurfaces::render(const MediumAmounts& medium, const Immersion& immersion,
                           const ShareRatios& shares, const HapticState& state, double period_s,
                           PointVectors& force_on_hand_n) noexcept {
  follow(immersion, state);
  const SolidAmounts plane = medium.plane();
  const SolidAmounts container = medium.container();
  for (int i = 0; i < kNumContactPoints; ++i) {
    force_on_hand_n[i].setZero();
    if (!state.attached[i]) {
      release(i);
      continue;
    }
    if (plane.is_there()) {
      force_on_hand_n[i] = contacts_[i].plane.force_n(
          share_of(plane, shares[i]), Eigen::Vector3d::UnitZ(),
          plane_depth_m(immersion, state.tip_position_m[i]), state.tip_position_m[i],
          state.tip_velocity_m_per_s[i], period_s);
    } else {
      contacts_[i].plane.release();
    }
    if (container.is_there()) {
      force_on_hand_n[i] +=
          container_force_n(share_of(container, shares[i]), i, state, period_s);
    }
  }
  if (!container.is_there()) held_bits_ = 0;
}

Eigen::Vector3d SolidSurfaces::container_force_n(const SolidAmounts& amounts, int point,
                                                 const HapticState& state,
                                                 double period_s) noexcept {
  const Eigen::Vector3d& position_m = state.tip_position_m[point];
  const Eigen::Vector3d& velocity_m_per_s = state.tip_velocity_m_per_s[point];
  Contacts& contacts = contacts_[point];
  const auto bit = static_cast<std::uint8_t>(1 << point);
  const double below_rim_m = plane_depth_m(immersion_, position_m);
  const bool was_held = (held_bits_ & bit) != 0;
  if (!(below_rim_m > 0.0) || !(was_held || immersion_.contains(position_m))) {
    held_bits_ = static_cast<std::uint8_t>(held_bits_ & ~bit);
    contacts.wall.release();
    contacts.bottom.release();
    return Eigen::Vector3d::Zero();
  }
  held_bits_ = static_cast<std::uint8_t>(held_bits_ | bit);
  Eigen::Vector3d force_n = contacts.bottom.force_n(amounts, Eigen::Vector3d::UnitZ(),
                                                    bottom_depth_m(immersion_, position_m),
                                                    position_m, velocity_m_per_s, period_s);
  const Eigen::Vector3d out_m = from_axis(immersion_, position_m);
  const double distance_m = out_m.norm();
  // On the axis no side of the wall is nearest. The wall is far away there, so any direction
  // serves.
  const Eigen::Vector3d inward =
      distance_m > 0.0 ? Eigen::Vector3d(-out_m / distance_m) : Eigen::Vector3d::UnitX();
  const double rim_ratio = std::min(1.0, below_rim_m / kRimM);
  force_n +=
      rim_ratio * contacts.wall.force_n(amounts, inward, distance_m - immersion_.radius_m,
                                        position_m, velocity_m_per_s, period_s);
  return force_n;
}

void SolidSurfaces::follow(const Immersion& immersion, const HapticState& state) noexcept {
  if (!is_released_ && !is_same(immersion, immersion_)) {
    for (int i = 0; i < kNumContactPoints; ++i) {
      const Eigen::Vector3d& at_m = state.tip_position_m[i];
      // Only an increase of depth is a rise of the surface. A NaN depth counts as outside.
      const auto rise_m = [](double now_m, double before_m) {
        return now_m - (before_m > 0.0 ? before_m : 0.0);
      };
      contacts_[i].plane.surface_rose(
          rise_m(plane_depth_m(immersion, at_m), plane_depth_m(immersion_, at_m)));
      contacts_[i].wall.surface_rose(
          rise_m(wall_depth_m(immersion, at_m), wall_depth_m(immersion_, at_m)));
      contacts_[i].bottom.surface_rose(
          rise_m(bottom_depth_m(immersion, at_m), bottom_depth_m(immersion_, at_m)));
    }
  }
  immersion_ = immersion;
  is_released_ = false;
}

void SolidSurfaces::release(int point) noexcept {
  contacts_[point] = Contacts();
  held_bits_ = static_cast<std::uint8_t>(held_bits_ & ~(1 << point));
}

void SolidSurfaces::release() noexcept {
  if (is_released_) return;
  for (int i = 0; i < kNumContactPoints; ++i) release(i);
  is_released_ = true;
}

}  // namespace jnd::core
