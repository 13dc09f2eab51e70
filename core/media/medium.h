#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "core/hand.h"
#include "core/media/ellipsoid_drag.h"
#include "core/media/force_map.h"
#include "core/media/god_object.h"
#include "core/media/inertial_drag.h"
#include "core/media/viscous_drag.h"
#include "core/media/water_drag.h"

namespace jnd::core {

/// What is felt, as amounts of each force law. Every law is linear in its amount, so media
/// combine by adding amounts, a ramp between two media is a straight line between their
/// amounts, and all amounts zero is free space, a medium like any other. A law whose amount is
/// zero costs nothing.
struct MediumAmounts {
  double quadratic_kg_per_m = 0.0;       ///< Of water: 1/2 scale density area, see `WaterDrag`.
  double damping_n_s_per_m = 0.0;        ///< Of a viscous fluid, see `ViscousDrag`.
  double plane_stiffness_n_per_m = 0.0;  ///< Of a solid surface, see `GodObject`.
  double plane_damping_n_s_per_m = 0.0;  ///< Of a solid surface while it is touched.
  double plane_friction_n_per_m = 0.0;   ///< Of it: friction ratio times stiffness.
  double mapped_drag_kg_per_m = 0.0;     ///< As of water, with the C_D of a `ForceMap`.
  double lift_kg_per_m = 0.0;            ///< As of water, with the C_L of a `ForceMap`.
  double inertial_n = 0.0;               ///< Drag at 1 m/s, see `InertialDrag`.
  double ellipsoid_fingers_n_s_per_m = 0.0;  ///< Along the fingers, see `EllipsoidDrag`.
  double ellipsoid_across_n_s_per_m = 0.0;   ///< Across them, in the hand plane.
  double ellipsoid_normal_n_s_per_m = 0.0;   ///< Along the hand plane's normal.
  double buoyancy_n = 0.0;                   ///< Upward, of the whole hand deep below.
  double container_stiffness_n_per_m = 0.0;  ///< Of its wall and bottom, see `SolidSurfaces`.
  double container_damping_n_s_per_m = 0.0;  ///< While they are touched.
  double container_friction_n_per_m = 0.0;   ///< Friction ratio times stiffness.

  /// Magnitude of the drag that is the same whichever way the hand is turned about its motion,
  /// in newtons, >= 0, 0 at rest: without ellipsoid, lift, buoyancy and solid surfaces.
  /// `map` nullptr: the thesis's C_D. Real time.
  [[nodiscard]] double drag_n(const HandMotion& motion,
                              const ForceMap* map = nullptr) const noexcept {
    double drag_n =
        (quadratic_kg_per_m * WaterDrag::drag_coefficient(motion.sin_angle_of_attack) *
             motion.speed_m_per_s +
         damping_n_s_per_m) *
        motion.speed_m_per_s;
    if (inertial_n != 0.0) drag_n += InertialDrag::drag_n(inertial_n, motion.speed_m_per_s);
    if (mapped_drag_kg_per_m != 0.0) {
      drag_n += mapped_drag_kg_per_m * mapped_drag_coefficient(motion, map) *
                motion.speed_m_per_s * motion.speed_m_per_s;
    }
    return drag_n;
  }

  [[nodiscard]] bool has_ellipsoid() const noexcept {
    return ellipsoid_fingers_n_s_per_m != 0.0 || ellipsoid_across_n_s_per_m != 0.0 ||
           ellipsoid_normal_n_s_per_m != 0.0;
  }
  [[nodiscard]] SolidAmounts plane() const noexcept {
    return {plane_stiffness_n_per_m, plane_damping_n_s_per_m, plane_friction_n_per_m};
  }
  [[nodiscard]] SolidAmounts container() const noexcept {
    return {container_stiffness_n_per_m, container_damping_n_s_per_m,
            container_friction_n_per_m};
  }

  /// Whether nothing is felt but drag that follows from the motion of the hand alone.
  [[nodiscard]] bool is_drag_of_motion() const noexcept;
  /// Whether the force is one damping times the velocity, whatever the speed and the pose.
  [[nodiscard]] bool is_plain_damping() const noexcept;
  /// Neither infinite nor NaN in any amount. Real time.
  [[nodiscard]] bool is_finite() const noexcept;
  /// Every amount that many times: the force is linear in them.
  [[nodiscard]] MediumAmounts times(double factor) const noexcept;
  MediumAmounts& operator+=(const MediumAmounts& other) noexcept;
  [[nodiscard]] friend MediumAmounts operator+(MediumAmounts left,
                                               const MediumAmounts& right) noexcept {
    return left += right;
  }
  [[nodiscard]] friend bool operator==(const MediumAmounts&,
                                       const MediumAmounts&) noexcept = default;
};

static_assert(std::is_trivially_copyable_v<MediumAmounts>);

/// Every amount, for whatever is done to all of them alike.
inline constexpr std::array kAmounts = {&MediumAmounts::quadratic_kg_per_m,
                                        &MediumAmounts::damping_n_s_per_m,
                                        &MediumAmounts::plane_stiffness_n_per_m,
                                        &MediumAmounts::plane_damping_n_s_per_m,
                                        &MediumAmounts::plane_friction_n_per_m,
                                        &MediumAmounts::mapped_drag_kg_per_m,
                                        &MediumAmounts::lift_kg_per_m,
                                        &MediumAmounts::inertial_n,
                                        &MediumAmounts::ellipsoid_fingers_n_s_per_m,
                                        &MediumAmounts::ellipsoid_across_n_s_per_m,
                                        &MediumAmounts::ellipsoid_normal_n_s_per_m,
                                        &MediumAmounts::buoyancy_n,
                                        &MediumAmounts::container_stiffness_n_per_m,
                                        &MediumAmounts::container_damping_n_s_per_m,
                                        &MediumAmounts::container_friction_n_per_m};
static_assert(sizeof(MediumAmounts) == kAmounts.size() * sizeof(double),
              "an amount is missing from the list");

/// Those of `drag_n` that need no map: drag that follows from the motion of the hand alone.
inline constexpr std::array kDragOfMotion = {&MediumAmounts::quadratic_kg_per_m,
                                             &MediumAmounts::damping_n_s_per_m,
                                             &MediumAmounts::inertial_n};

[[nodiscard]] inline MediumAmounts free_space() noexcept { return {}; }
/// Throw `Error` for parameters out of range. Not real time.
[[nodiscard]] MediumAmounts water(const WaterDrag::Parameters& parameters);
/// Water whose drag and lift a `ForceMap` tells.
[[nodiscard]] MediumAmounts mapped_water(const WaterDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts viscous(const ViscousDrag::Parameters& parameters);
/// A viscous fluid with the drag of its inertia on top.
[[nodiscard]] MediumAmounts viscous_inertial(const InertialDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts ellipsoid(const EllipsoidDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts solid(const SolidParameters& parameters);
/// Wall and bottom where the `Immersion` of the command ends; what fills it is added.
[[nodiscard]] MediumAmounts container(const SolidParameters& parameters);
/// `buoyancy_n` finite, >= 0: the weight of the water that the hand displaces less its own.
[[nodiscard]] MediumAmounts buoyant(double buoyancy_n);

/// The medium on its way from what was felt to what was commanded: a straight line in every
/// amount over `ramp_s`, starting from wherever an unfinished ramp had come to. Real time.
class MediumRamp {
 public:
  void start(const MediumAmounts& target, double ramp_s) noexcept;
  /// Moves on by the time since the last tick and returns what is to be rendered in this one.
  const MediumAmounts& advance(double elapsed_s) noexcept;
  [[nodiscard]] const MediumAmounts& current() const noexcept { return current_; }
  [[nodiscard]] bool finished() const noexcept { return arrived_; }

 private:
  MediumAmounts current_;
  MediumAmounts target_;
  double remaining_s_ = 0.0;
  bool arrived_ = true;
};

}  // namespace jnd::core
