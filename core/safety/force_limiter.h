#pragma once

#include <array>

#include "core/hand.h"
#include "core/safety/fault.h"

namespace jnd::core {

/// The last stage of every force. After `limit`, whatever came in:
/// - a point that is not attached gets exactly zero, at once;
/// - no point gets more than `per_point_n`;
/// - the magnitudes of all points add up to at most `total_n`, and so does the resultant;
/// - no point's force vector changes by more than `slew_n_per_s` times the period;
/// - a number that is not finite, or a point that is too fast, latches a fault: the force is
///   zero until `rearm`, and then starts from zero within the slew.
///
/// Clamps keep directions. A point's limit scales its vector, the total scales all points
/// alike, and the slew moves all points along the straight line from the forces sent last. Real
/// time except the constructor.
class ForceLimiter {
 public:
  struct Parameters {
    double per_point_n = 10.0;       ///< > 0, finite.
    double total_n = 30.0;           ///< > 0, finite.
    double slew_n_per_s = 2000.0;    ///< > 0, finite.
    double max_speed_m_per_s = 5.0;  ///< Speed of any attached point, > 0, finite.
  };

  /// Throws `Error` naming the field; `period_s` > 0. Not real time.
  ForceLimiter(const Parameters& parameters, double period_s);

  /// Limits the forces on the hand in place, in the workspace frame. Returns whether it changed
  /// any.
  bool limit(const std::array<bool, kNumContactPoints>& attached,
             const PointVectors& tip_velocity_m_per_s, PointVectors& force_on_hand_n) noexcept;

  [[nodiscard]] Fault fault() const noexcept { return fault_; }

  /// Forgets the fault and starts again from zero force.
  void rearm() noexcept;

 private:
  [[nodiscard]] Fault found_fault(const std::array<bool, kNumContactPoints>& attached,
                                  const PointVectors& tip_velocity_m_per_s,
                                  const PointVectors& force_on_hand_n) const noexcept;

  Parameters parameters_;
  double max_step_n_;
  Fault fault_ = Fault::kNone;
  PointVectors last_n_ = zero_vectors();
};

}  // namespace jnd::core
