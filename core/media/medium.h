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

/// What is felt, as amounts of the force laws. Every law is linear in its amount. So media
/// combine by adding their amounts, a ramp between two media is a straight line between their
/// amounts, and free space is the medium whose amounts are all zero. A law whose amount is zero
/// costs no time.
struct MediumAmounts {
  double quadratic_kg_per_m = 0.0;       ///< Water: 1/2 scale density area, see `WaterDrag`.
  double damping_n_s_per_m = 0.0;        ///< Viscous fluid, see `ViscousDrag`.
  double plane_stiffness_n_per_m = 0.0;  ///< Solid surface, see `GodObject`.
  double plane_damping_n_s_per_m = 0.0;  ///< Solid surface, while it is touched.
  double plane_friction_n_per_m = 0.0;   ///< Solid surface: friction ratio times stiffness.
  double mapped_drag_kg_per_m = 0.0;     ///< Like water, with the C_D of a `ForceMap`.
  double lift_kg_per_m = 0.0;            ///< Like water, with the C_L of a `ForceMap`.
  double inertial_n = 0.0;               ///< Drag at 1 m/s, no added mass; see `InertialDrag`.
  double ellipsoid_fingers_n_s_per_m = 0.0;  ///< Along the fingers, see `EllipsoidDrag`.
  double ellipsoid_across_n_s_per_m = 0.0;   ///< Across them, in the hand plane.
  double ellipsoid_normal_n_s_per_m = 0.0;   ///< Along the hand plane's normal.
  /// Upward force on the whole hand deep below the surface.
  double buoyancy_n = 0.0;
  /// Wall and bottom of the container, see `SolidSurfaces`.
  double container_stiffness_n_per_m = 0.0;
  double container_damping_n_s_per_m = 0.0;  ///< Wall and bottom, while they are touched.
  /// Wall and bottom: friction ratio times stiffness.
  double container_friction_n_per_m = 0.0;

  /// Returns the magnitude of the drag that depends on the hand's speed and angle of attack
  /// only, in newtons, >= 0, and 0 at rest. Ellipsoid, lift, buoyancy and solid surfaces are
  /// not in it. With `map` nullptr it uses the thesis's C_D. Real time.
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
  /// Whether no amount is infinite or NaN. Real time.
  [[nodiscard]] bool is_finite() const noexcept;
  /// Whether no amount of it is larger than the one of `other`. Real time.
  [[nodiscard]] bool is_nowhere_more_than(const MediumAmounts& other) const noexcept;
  /// Multiplies every amount by the factor, and so the force, which is linear in them.
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

/// Lists every amount, for operations on all of them.
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
/// These functions throw `Error` for parameters out of range. Not real time.
[[nodiscard]] MediumAmounts water(const WaterDrag::Parameters& parameters);
/// Water whose drag and lift come from a `ForceMap`.
[[nodiscard]] MediumAmounts mapped_water(const WaterDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts viscous(const ViscousDrag::Parameters& parameters);
/// A viscous fluid with the additional drag of its inertia.
[[nodiscard]] MediumAmounts viscous_inertial(const InertialDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts ellipsoid(const EllipsoidDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts solid(const SolidParameters& parameters);
/// Wall and bottom at the limits of the command's `Immersion`. The medium that fills it is
/// added.
[[nodiscard]] MediumAmounts container(const SolidParameters& parameters);
/// `buoyancy_n` is the weight of the displaced water minus the hand's own weight, finite, >= 0.
[[nodiscard]] MediumAmounts buoyant(double buoyancy_n);

/// The transition from the medium that was felt to the commanded one. Every amount follows a
/// straight line over `ramp_s`, starting from wherever an unfinished ramp has arrived. Real
/// time.
class MediumRamp {
 public:
  void start(const MediumAmounts& target, double ramp_s) noexcept;
  /// Moves on by this time and returns what is to be rendered now. It is the time since the
  /// last tick, but of that only what lies after `start`.
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
