#pragma once

#include <array>
#include <cstdint>

#include "core/hand.h"

namespace jnd::core {

/// Time-domain passivity observer and controller, one a contact point (Hannaford and Ryu 2002).
/// The observer adds up the energy that each point has really put into the medium, from the
/// force last sent and the way moved since. Where the force about to be sent pushes along the
/// motion and would give back more than was put in, the controller takes away just enough of
/// that push, and never more than all of it. So it never adds force, never pulls, and a drag
/// law, which does not push along the motion, passes unchanged.
///
/// The credit a point can gather is bounded: energy dissipated long ago must not pay for a
/// surface that generates some now. Real time, no heap.
class PassivityController {
 public:
  struct Parameters {
    /// Per point, > 0, finite; more than a surface or buoyancy can store: 10 N against 700 N/m
    /// hold 0.07 J, a hand pushed under by 8 N over a third of a metre nearly 1 J.
    double max_credit_j = 1.0;
  };

  /// Throws `Error` naming the field; `period_s` > 0. Not real time.
  PassivityController(const Parameters& parameters, double period_s);

  /// Corrects the force about to be sent; workspace frame. Returns whether it changed any.
  /// Values that are not finite pass through to the limiter and are not added up.
  bool control(const PointVectors& tip_position_m, const PointVectors& tip_velocity_m_per_s,
               PointVectors& force_on_hand_n) noexcept;

  /// Tells what was sent in the end, after every limit.
  void sent(const PointVectors& force_on_hand_n) noexcept { last_force_n_ = force_on_hand_n; }

  /// A medium that stores has been put around the hand, which has put nothing into it: each
  /// point of `storing_bits` may give back the whole credit once, as a float lifts a hand that
  /// it was put around. Without that the controller takes each push away along a velocity that
  /// near rest is noise, which is a buzz.
  void grant_credit(std::uint8_t storing_bits) noexcept;

  /// Energy put into the medium at this point and not yet given back, in joules.
  [[nodiscard]] double credit_j(ContactPoint point) const noexcept {
    return credit_j_[static_cast<int>(point)];
  }

  /// Forgets all, as before the first tick.
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
