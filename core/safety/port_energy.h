#pragma once

#include <array>
#include <cstdint>

#include "core/hand.h"

namespace jnd::core {

/// Observes at each contact point the energy that the device gives to the hand, from the force
/// that acted and the displacement under it (Hannaford and Ryu 2002): work = F . dx. It uses
/// positions alone, so a velocity that is late, filtered or of the wrong sign does not deceive
/// it. Both must be of the same time: if a device acts late, this is the force that acted and
/// not the one sent last.
///
/// A point that a surface holds, or that floats, may give back what the medium stores, up to a
/// credit. A fluid stores nothing, so what the hand put into it before pays for nothing later.
/// Beyond the credit a point may give little: `is_exceeded` is true once a point has given more
/// than `max_given_j`. The observer forgets given energy with a time constant of `memory_s`, so
/// that the noise of a hand at rest does not add up. Real time except the constructor.
class PortEnergy {
 public:
  struct Parameters {
    double max_given_j = 0.02;  ///< Of one point, > 0, finite.
    double memory_s = 0.25;     ///< > 0, finite.
    /// Credit of one point in a medium that stores energy, > 0, finite; see
    /// `PassivityController`.
    double max_credit_j = 1.0;
  };

  /// Throws `Error` naming the field; `period_s` > 0. Not real time.
  PortEnergy(const Parameters& parameters, double period_s);

  /// Takes one measurement. `acted_n` is the force on the hand since the measurement before, in
  /// the workspace frame. Bit i of `storing_bits` is 1 if a surface holds contact point i or it
  /// floats. Values that are not finite are not added up, nor is the displacement of a point
  /// that is detached or was attached again just now.
  void observe(const PointVectors& tip_position_m, const PointVectors& acted_n,
               const std::array<bool, kNumContactPoints>& attached,
               std::uint8_t storing_bits) noexcept;

  /// Tells that a medium was put around the hand and may push it out. Once, and up to the
  /// credit, each point may give energy that it did not get before, while it is held or floats.
  void grant_credit() noexcept;

  [[nodiscard]] bool is_exceeded() const noexcept { return is_exceeded_; }
  /// Whether some point is now more than half way to the limit.
  [[nodiscard]] bool is_near() const noexcept { return is_near_; }
  /// Returns the energy, in joules, that this point has given beyond its credit and that is not
  /// yet forgotten. A value below 0 is its credit.
  [[nodiscard]] double given_j(int point) const noexcept { return given_j_[point]; }

  /// Forgets what was given beyond the credit, and keeps the credit.
  void forgive() noexcept;

  /// Forgets everything, as before the first measurement.
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
