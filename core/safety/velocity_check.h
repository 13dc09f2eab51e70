#pragma once

#include <array>

#include "core/hand.h"

namespace jnd::core {

/// Compares the velocity that a device reports with its own positions: at each held point the
/// way by velocity, v dt, less the way moved is added up, and forgotten with a time constant of
/// `memory_s`. More than `max_error_m`, and more than `max_error_ratio` of the way that was
/// moved in that time, is a contradiction: a wrong sign, unit or axis, a velocity that stands
/// still, or one so late that a fluid made of it would push. Lengths are sums of the
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

  /// One measurement, `elapsed_s` > 0 after the one before by the device's clock; workspace
  /// frame.
  void observe(const PointVectors& tip_position_m, const PointVectors& tip_velocity_m_per_s,
               const std::array<bool, kNumContactPoints>& attached, double elapsed_s) noexcept;

  [[nodiscard]] bool is_contradicted() const noexcept { return is_contradicted_; }
  /// Some point is now more than half way there.
  [[nodiscard]] bool is_near() const noexcept { return is_near_; }

  /// Forgets all, as before the first measurement.
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
