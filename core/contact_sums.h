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
  double speed_m_per_s = 0.0;            ///< |v|
  double opposing_n = 0.0;               ///< -F . v / |v|, 0 at rest; F as in opposing_w.

  [[nodiscard]] friend ContactSums operator-(const ContactSums& until,
                                             const ContactSums& from) noexcept {
    return {
        .num_ticks = until.num_ticks - from.num_ticks,
        .opposing_w = until.opposing_w - from.opposing_w,
        .rendered_opposing_w = until.rendered_opposing_w - from.rendered_opposing_w,
        .speed_squared_m2_per_s2 = until.speed_squared_m2_per_s2 - from.speed_squared_m2_per_s2,
        .speed_m_per_s = until.speed_m_per_s - from.speed_m_per_s,
        .opposing_n = until.opposing_n - from.opposing_n};
  }

  /// Slope of the regression of the opposing force on speed, with an intercept: rendered force
  /// and mechanical viscosity together. Dry friction, the same at every speed, is in the
  /// intercept. 0 without any spread of speed.
  [[nodiscard]] double felt_damping_n_s_per_m() const noexcept {
    if (num_ticks == 0) return 0.0;
    const auto n = static_cast<double>(num_ticks);
    const double spread = speed_squared_m2_per_s2 - speed_m_per_s * speed_m_per_s / n;
    if (!(spread > 1e-9 * n)) return 0.0;
    return (opposing_w - opposing_n * speed_m_per_s / n) / spread;
  }
  /// Slope of the rendered force alone through the origin: what the stimulus came out as, the
  /// power taken from the hand over its squared speed. 0 without motion.
  [[nodiscard]] double delivered_damping_n_s_per_m() const noexcept {
    return speed_squared_m2_per_s2 > 0.0 ? rendered_opposing_w / speed_squared_m2_per_s2 : 0.0;
  }
};

static_assert(std::is_trivially_copyable_v<ContactSums>);

}  // namespace jnd::core
