#pragma once

#include <array>
#include <cstdint>

#include "core/hand.h"

namespace jnd::core {

/// Observes at each contact point the energy that the device gives to the hand, from the force
/// that acted and the way that was moved under it (Hannaford and Ryu 2002): work = F . dx, of
/// positions alone, so that a velocity that is late, filtered or of the wrong sign deceives it
/// not. Both have to be of the same time: of a device that acts late, the force that acted and
/// not the one sent last.
///
/// A point may give back what a medium stores, up to a credit: a point that a surface holds, or
/// that floats. A fluid stores nothing, so what the hand put into it before pays for nothing
/// later. Beyond the credit a point may give little:
/// `is_exceeded` once a point has given more than `max_given_j`, of which the observer forgets
/// with a time constant of `memory_s`, so that the noise of a hand at rest does not add up.
/// Real time except the constructor.
class PortEnergy {
 public:
  struct Parameters {
    double max_given_j = 0.02;  ///< Of one point, > 0, finite.
    double memory_s = 0.25;     ///< > 0, finite.
    /// Of one point of a medium that stores, > 0, finite; see `PassivityController`.
    double max_credit_j = 1.0;
  };

  /// Throws `Error` naming the field; `period_s` > 0. Not real time.
  PortEnergy(const Parameters& parameters, double period_s);

  /// One measurement. `acted_n`: on the hand, from the measurement before until this one;
  /// workspace frame. `storing_bits`: bit i where contact point i is held by a surface or
  /// floats. Values that are not finite are not added up,
  /// nor is the way of a point that does not hold the hand or has just been put back.
  void observe(const PointVectors& tip_position_m, const PointVectors& acted_n,
               const std::array<bool, kNumContactPoints>& attached,
               std::uint8_t storing_bits) noexcept;

  /// A medium that has been put around the hand may push it out: once, and by no more than the
  /// credit, each point may give what it did not get before, while it is held or floats.
  void grant_credit() noexcept;

  [[nodiscard]] bool is_exceeded() const noexcept { return is_exceeded_; }
  /// Some point is now more than half way there.
  [[nodiscard]] bool is_near() const noexcept { return is_near_; }
  /// What this point has given beyond its credit and is not forgotten yet, in joules; below 0:
  /// its credit.
  [[nodiscard]] double given_j(int point) const noexcept { return given_j_[point]; }

  /// Forgets what was given beyond the credit, which stays.
  void forgive() noexcept;

  /// Forgets all, as before the first measurement.
  void reset() noexcept;

 private:
  double max_given_j_;
  double kept_ratio_;
  double max_credit_j_;
  bool has_last_ = false;
  bool is_exceeded_ = false;
  bool is_near_ = false;
  std::array<bool, kNumContactPoints> was_held_{};
  std::array<double, kNumContactPoints> given_j_{};
  std::array<double, kNumContactPoints> granted_j_{};
  PointVectors last_position_m_ = zero_vectors();
};

}  // namespace jnd::core
