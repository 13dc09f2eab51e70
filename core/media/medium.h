#pragma once

#include <type_traits>

#include "core/hand.h"
#include "core/media/solid_plane.h"
#include "core/media/viscous_drag.h"
#include "core/media/water_drag.h"

namespace jnd::core {

/// What is felt, as amounts of each force law. Every law is linear in its amount, so media
/// combine by adding amounts, a ramp between two media is a straight line between their
/// amounts, and all amounts zero is free space, a medium like any other.
struct MediumAmounts {
  double quadratic_kg_per_m = 0.0;       ///< Of water: 1/2 scale density area, see `WaterDrag`.
  double damping_n_s_per_m = 0.0;        ///< Of a viscous fluid, see `ViscousDrag`.
  double plane_stiffness_n_per_m = 0.0;  ///< Of a solid surface, see `SolidPlane`.
  double plane_damping_n_s_per_m = 0.0;  ///< Of a solid surface while it is touched.

  /// Magnitude of the drag on the whole hand, in newtons, >= 0, 0 at rest; without the solid
  /// surface. Real time.
  [[nodiscard]] double drag_n(const HandMotion& motion) const noexcept {
    return (quadratic_kg_per_m * WaterDrag::drag_coefficient(motion.sin_angle_of_attack) *
                motion.speed_m_per_s +
            damping_n_s_per_m) *
           motion.speed_m_per_s;
  }
};

static_assert(std::is_trivially_copyable_v<MediumAmounts>);

[[nodiscard]] inline MediumAmounts free_space() noexcept { return {}; }
/// Throw `Error` for parameters out of range. Not real time.
[[nodiscard]] MediumAmounts water(const WaterDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts viscous(const ViscousDrag::Parameters& parameters);
[[nodiscard]] MediumAmounts solid(const SolidPlane::Parameters& parameters);

/// The medium on its way from what was felt to what was commanded: a straight line in every
/// amount over `ramp_s`, starting from wherever an unfinished ramp had come to. Real time.
class MediumRamp {
 public:
  void start(const MediumAmounts& target, double ramp_s) noexcept;
  /// Moves on by one tick and returns what is to be rendered in it.
  const MediumAmounts& advance(double period_s) noexcept;
  [[nodiscard]] const MediumAmounts& current() const noexcept { return current_; }
  [[nodiscard]] bool finished() const noexcept { return remaining_s_ <= 0.0; }

 private:
  MediumAmounts current_;
  MediumAmounts target_;
  double remaining_s_ = 0.0;
};

}  // namespace jnd::core
