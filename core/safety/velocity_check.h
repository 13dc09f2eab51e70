#pragma once

#include <array>

#include "core/hand.h"

namespace jnd::core {

/// Compares the velocity that a device reports with its own positions. At each attached point
/// it adds up the displacement by velocity, v dt, minus the measured one, and forgets the sum
/// with a time constant of `memory_s`. A sum above `max_error_m` and above `max_error_ratio` of
/// the path in that time is a contradiction: a wrong sign, unit or axis, a velocity that stands
/// still, or one so late that a fluid computed from it would push. Lengths are sums of the
/// components' magnitudes. Real time except the constructor.
class VelocityCheck {
 public:
  struct Parameters {
    double max_error_m = 0.02;     ///< > 0, finite.
    double max_error_ratio = 0.5;  ///< > 0, finite.
    double memory_s = 0.1;         ///< > 0, finite.
  };

  /// Throws `Error` naming the field. Not real time.
  explicit VelocityCheck(const Parameters& parameters);

  /// Takes one measurement, `elapsed_s` > 0 after the one before by the device's clock, in the
  /// workspace frame.
  void observe(const PointVectors& tip_position_m, const PointVectors& tip_velocity_m_per_s,
               const std::array<bool, kNumContactPoints>& attached, double elapsed_s) noexcept;

  [[nodiscard]] bool is_contradicted() const noexcept { return is_contradicted_; }
  /// Whether some point is now more than half way to a contradiction.
  [[nodiscard]] bool is_near() const noexcept { return is_near_; }

  /// Forgets everything, as before the first measurement.
  void reset() noexcept;

 private:
  Parameters parameters_;
  bool has_last_ = false;
  bool is_contradicted_ = false;
  bool is_near_ = false;
  std::array<bool, kNumContactPoints> was_held_{};
  PointVectors last_position_m_ = zero_vectors();
  PointVectors error_m_ = zero_vectors();
  std::array<double, kNumContactPoints> way_m_{};
};

}  // namespace jnd::core
