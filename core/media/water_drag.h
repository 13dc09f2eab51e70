#pragma once

namespace jnd::core {

/// Drag of water on a stiff hand, quadratic in speed (thesis, sec. 4.1 and B.4):
///
///   force = 1/2 density speed^2 area C_D(alpha),  C_D = 0.5794 - 0.3105 cos(2 alpha)
///
/// alpha is the angle between the hand plane and the direction of motion. The thesis fitted C_D
/// to published measurements. Its eq. B.5 prints a wrong sign; this is eq. B.4.
class WaterDrag {
 public:
  struct Parameters {
    double scale = 1.0;                 ///< Factor on the physical force, >= 0; water has 1.
    double density_kg_per_m3 = 1000.0;  ///< > 0.
    double projected_area_m2 = 0.0148;  ///< Of the hand, > 0 (Sato and Hino 2003).
  };

  /// Throws `Error` naming the field. Not real time.
  explicit WaterDrag(const Parameters& parameters);

  /// Real time.
  [[nodiscard]] static double drag_coefficient(double sin_angle_of_attack) noexcept {
    return 0.5794 - 0.3105 * (1.0 - 2.0 * sin_angle_of_attack * sin_angle_of_attack);
  }

  /// Returns force / (C_D speed^2): 1/2 scale density area.
  [[nodiscard]] double quadratic_kg_per_m() const noexcept { return quadratic_kg_per_m_; }

  /// Returns the magnitude of the force in newtons, which acts against the motion. Real time.
  [[nodiscard]] double drag_n(double speed_m_per_s, double sin_angle_of_attack) const noexcept {
    return quadratic_kg_per_m_ * drag_coefficient(sin_angle_of_attack) * speed_m_per_s *
           speed_m_per_s;
  }

 private:
  double quadratic_kg_per_m_;
};

}  // namespace jnd::core
