#pragma once

#include <cmath>

#include "core/media/viscous_drag.h"

namespace jnd::core {

/// Drag of a viscous fluid on the hand at speeds where the fluid's inertia begins to count
/// (Schiller and Naumann 1935, for a sphere):
///
///   C_D = 24/Re (1 + 0.15 Re^0.687),  Re = density speed length / viscosity
///
/// This C_D is put into the drag equation as the thesis does with 24/Re, so the first term is
/// its `ViscousDrag`. The second term grows with speed^1.687. Its amount is the force at 1 m/s.
/// The correction holds up to Re 800. Beyond that, true drag grows with the square of speed
/// like water's, and this drag stays below it (`jnd force` says so). The hand of the thesis's
/// group D has a Re of about 24 and would feel 2.3 times the drag, so a study renders this law
/// only if it asks for it. Both terms depend on speed alone: this is drag, and no added mass.
class InertialDrag {
 public:
  struct Parameters {
    double viscosity_pa_s;              ///< Dynamic viscosity, >= 0.
    double density_kg_per_m3 = 1000.0;  ///< > 0.
    double projected_area_m2 = 0.0148;  ///< Of the hand, > 0.
    double length_m = 0.1;              ///< Characteristic length, > 0.
  };

  static constexpr double kMaxReynolds = 800.0;

  /// Throws `Error` naming the field. Not real time.
  explicit InertialDrag(const Parameters& parameters);

  /// Coefficient of the first term, a damping.
  [[nodiscard]] double damping_n_s_per_m() const noexcept { return damping_n_s_per_m_; }
  /// Coefficient of the second term: its force at 1 m/s.
  [[nodiscard]] double inertial_n() const noexcept { return inertial_n_; }
  /// The correction does not hold beyond this speed, which is infinite without inertia.
  [[nodiscard]] double max_speed_m_per_s() const noexcept { return max_speed_m_per_s_; }

  /// Magnitude of the second term, which acts against the motion. Real time.
  [[nodiscard]] static double drag_n(double inertial_n, double speed_m_per_s) noexcept {
    return inertial_n * std::pow(speed_m_per_s, 1.687);
  }

 private:
  double damping_n_s_per_m_;
  double inertial_n_;
  double max_speed_m_per_s_;
};

}  // namespace jnd::core
