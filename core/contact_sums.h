#pragma once

#include <cstdint>
#include <type_traits>

namespace jnd::core {

/// Sums over ticks of what a simulated hand has felt since its device was opened. The
/// difference of two of them tells what happened in between, for example during one
/// presentation. A force counts as positive if it opposes the motion: -F . v / |v|, and 0 at
/// rest.
struct ContactSums {
  std::int64_t num_ticks = 0;
  double opposing_n = 0.0;           ///< All forces of the device on the hand.
  double rendered_opposing_n = 0.0;  ///< Only the forces that the loop sent, after every limit.
  double speed_m_per_s = 0.0;        ///< |v|

  [[nodiscard]] friend ContactSums operator-(const ContactSums& until,
                                             const ContactSums& from) noexcept {
    return {.num_ticks = until.num_ticks - from.num_ticks,
            .opposing_n = until.opposing_n - from.opposing_n,
            .rendered_opposing_n = until.rendered_opposing_n - from.rendered_opposing_n,
            .speed_m_per_s = until.speed_m_per_s - from.speed_m_per_s};
  }

  /// The delivered stimulus: mean rendered force divided by mean speed. It is the slope of the
  /// regression of force on speed through the origin if the variance grows with speed. For a
  /// viscous fluid it is the fluid's damping, and less if the limiter reduced the force. 0
  /// without motion.
  [[nodiscard]] double delivered_damping_n_s_per_m() const noexcept {
    return speed_m_per_s > 0.0 ? rendered_opposing_n / speed_m_per_s : 0.0;
  }

  /// The damping that the device itself adds: everything that opposed the hand beyond the
  /// rendered force, divided by mean speed. Over whole strokes, the inertial forces of masses
  /// cancel out.
  [[nodiscard]] double device_damping_n_s_per_m() const noexcept {
    return speed_m_per_s > 0.0 ? (opposing_n - rendered_opposing_n) / speed_m_per_s : 0.0;
  }
};

static_assert(std::is_trivially_copyable_v<ContactSums>);

}  // namespace jnd::core
