#pragma once

namespace jnd::core {

/// Drag of a very viscous fluid on the hand, linear in speed and independent of the hand's pose
/// (thesis, sec. 5.1 and B.4). Two constants are on offer:
///
///   kFlatPlate: C_D = 24/Re put into the drag equation, force = 12 (area / length) viscosity
///   speed
///               = 1.7760 m * viscosity * speed. The studies use this one.
///   kSphere:    Stokes (1851), force = 6 pi radius viscosity speed = 1.2322 m * viscosity *
///   speed,
///               on the sphere with the surface of a prolate spheroid of semi-axes 0.10 and
///               0.05 m.
class ViscousDrag {
 public:
  enum class Shape { kFlatPlate, kSphere };
  /// What a tool that is held like a pen moves through the fluid if nobody says.
  static constexpr double kToolRadiusM = 0.01;

  struct Parameters {
    double viscosity_pa_s;  ///< Dynamic viscosity, >= 0. Honey about 10.
    Shape shape = Shape::kFlatPlate;
    double projected_area_m2 = 0.0148;  ///< Of the hand, > 0; used by kFlatPlate.
    double length_m = 0.1;              ///< Characteristic length, > 0; used by kFlatPlate.
    double semi_major_axis_m = 0.10;    ///< Of the spheroid, > semi-minor; used by kSphere.
    double semi_minor_axis_m = 0.05;    ///< > 0; used by kSphere.
    /// Of a sphere that is given as such, > 0; 0: by the spheroid. Used by kSphere.
    double radius_m = 0.0;
  };

  /// Throws `Error` naming the field. Not real time.
  explicit ViscousDrag(const Parameters& parameters);

  /// Force per viscosity and speed, in metres: 1.7760 or 1.2322 with the default sizes.
  [[nodiscard]] double shape_constant_m() const noexcept { return shape_constant_m_; }

  [[nodiscard]] double damping_n_s_per_m() const noexcept { return damping_n_s_per_m_; }

  /// Magnitude in newtons, against the motion. Real time.
  [[nodiscard]] double drag_n(double speed_m_per_s) const noexcept {
    return damping_n_s_per_m_ * speed_m_per_s;
  }

 private:
  double shape_constant_m_;
  double damping_n_s_per_m_;
};

/// Radius of the sphere with the same surface as a prolate spheroid of these semi-axes.
[[nodiscard]] double equal_surface_radius_m(double semi_major_axis_m, double semi_minor_axis_m);

}  // namespace jnd::core
