#pragma once

#include <array>
#include <cstdint>

#include "core/hand.h"

namespace jnd::core {

/// Passivity observer and controller in the time domain, one for each contact point (Hannaford
/// and Ryu 2002). The observer adds up the energy that each point has really put into the
/// medium, from the force sent last and the displacement since. If the force about to be sent
/// pushes along the motion and would give back more than was put in, the controller takes away
/// just enough of that push, and never more than all of it. So it never adds force and never
/// pulls. A drag does not push along the motion, so it passes unchanged.
///
/// The credit of a point is bounded, so that energy dissipated long ago does not pay for a
/// surface that generates some now. Real time, no heap.
class PassivityController {
 public:
  struct Parameters {
    /// Bound of the credit of each point, > 0, finite. It exceeds what a surface or buoyancy
    /// can store: 10 N against 700 N/m hold 0.07 J, and a hand pushed under by 8 N over a third
    /// of a metre nearly 1 J.
    double max_credit_j = 1.0;
  };

  /// Throws `Error` naming the field; `period_s` > 0. Not real time.
  PassivityController(const Parameters& parameters, double period_s);

  /// Corrects the forces about to be sent, in the workspace frame. Returns whether it changed
  /// any. Values that are not finite pass on to the limiter and are not added up.
  bool control(const PointVectors& tip_position_m, const PointVectors& tip_velocity_m_per_s,
               PointVectors& force_on_hand_n) noexcept;

  /// Tells which forces were sent in the end, after every limit.
  void sent(const PointVectors& force_on_hand_n) noexcept { last_force_n_ = force_on_hand_n; }

  /// Tells that a medium that stores energy was put around the hand, which has put nothing into
  /// it. Each point of `storing_bits` may then give back the whole credit once, as buoyancy
  /// lifts a hand that it was put around. Otherwise the controller would take each push away
  /// along a velocity that near rest is noise, which buzzes.
  void grant_credit(std::uint8_t storing_bits) noexcept;

  /// Returns the energy, in joules, that this point has put into the medium and not got back.
  [[nodiscard]] double credit_j(ContactPoint point) const noexcept {
    return credit_j_[static_cast<int>(point)];
  }

  /// Forgets everything, as before the first tick.
  void reset() noexcept;

 private:
  double max_credit_j_;
  double period_s_;
  bool has_last_ = false;
  std::array<double, kNumContactPoints> credit_j_{};
  PointVectors last_position_m_ = zero_vectors();
  PointVectors last_force_n_ = zero_vectors();
};

}  // namespace jnd::core
