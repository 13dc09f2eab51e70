#pragma once

#include <cstdint>
#include <type_traits>

namespace jnd::core {

/// What a simulated hand has been through since its device was opened, added up over ticks. The
/// difference of two of them is what happened in between, for example over one presentation.
/// Power counts positive where the force opposes the motion.
struct ContactSums {
  std::int64_t num_ticks = 0;
  double opposing_w = 0.0;               ///< -F . v; F all that the device does to the hand.
  double rendered_opposing_w = 0.0;      ///< -F . v; F the force that the loop sent, alone.
  double speed_squared_m2_per_s2 = 0.0;  ///< v . v

  [[nodiscard]] friend ContactSums operator-(const ContactSums& until,
                                             const ContactSums& from) noexcept {
    return {.num_ticks = until.num_ticks - from.num_ticks,
            .opposing_w = until.opposing_w - from.opposing_w,
            .rendered_opposing_w = until.rendered_opposing_w - from.rendered_opposing_w,
            .speed_squared_m2_per_s2 =
                until.speed_squared_m2_per_s2 - from.speed_squared_m2_per_s2};
  }

  /// Slope of force against motion on velocity, through the origin: rendered force, mechanical
  /// viscosity and friction together. 0 without motion.
  [[nodiscard]] double felt_damping_n_s_per_m() const noexcept {
    return speed_squared_m2_per_s2 > 0.0 ? opposing_w / speed_squared_m2_per_s2 : 0.0;
  }
  /// The same of the rendered force alone: what the stimulus came out as. 0 without motion.
  [[nodiscard]] double delivered_damping_n_s_per_m() const noexcept {
    return speed_squared_m2_per_s2 > 0.0 ? rendered_opposing_w / speed_squared_m2_per_s2 : 0.0;
  }
};

static_assert(std::is_trivially_copyable_v<ContactSums>);

}  // namespace jnd::core
