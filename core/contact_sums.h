#pragma once

#include <cstdint>
#include <type_traits>

namespace jnd::core {

/// What a simulated hand has been through since its device was opened, added up over ticks. The
/// difference of two of them is what happened in between, for example over one presentation.
/// Forces count positive where they oppose the motion: -F . v / |v|, 0 at rest.
struct ContactSums {
  std::int64_t num_ticks = 0;
  double opposing_n = 0.0;           ///< All that the device does to the hand.
  double rendered_opposing_n = 0.0;  ///< What the loop sent, after every limit, alone.
  double speed_m_per_s = 0.0;        ///< |v|

  [[nodiscard]] friend ContactSums operator-(const ContactSums& until,
                                             const ContactSums& from) noexcept {
    return {.num_ticks = until.num_ticks - from.num_ticks,
            .opposing_n = until.opposing_n - from.opposing_n,
            .rendered_opposing_n = until.rendered_opposing_n - from.rendered_opposing_n,
            .speed_m_per_s = until.speed_m_per_s - from.speed_m_per_s};
  }

  /// What the stimulus came out as: mean rendered force over mean speed. It is the slope of the
  /// regression of force on speed through the origin with a variance that grows with speed; for
  /// a viscous fluid it is the fluid's damping, and less where the limiter held force back. 0
  /// without motion.
  [[nodiscard]] double delivered_damping_n_s_per_m() const noexcept {
    return speed_m_per_s > 0.0 ? rendered_opposing_n / speed_m_per_s : 0.0;
  }

  /// What the device adds by itself: all that opposed the hand beyond the rendered force, over
  /// mean speed. Over whole strokes the hand's pushing and being pushed by masses cancel out.
  [[nodiscard]] double device_damping_n_s_per_m() const noexcept {
    return speed_m_per_s > 0.0 ? (opposing_n - rendered_opposing_n) / speed_m_per_s : 0.0;
  }
};

static_assert(std::is_trivially_copyable_v<ContactSums>);

}  // namespace jnd::core
