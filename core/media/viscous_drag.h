#pragma once

namespace jnd::core {

/// Drag of a very viscous fluid on the hand. It is linear in speed and independent of the
/// hand's pose (thesis, sec. 5.1 and B.4). There are two shapes:
///
///   kFlatPlate: C_D = 24/Re put into the drag equation, which gives force = 12 (area / length)
///   viscosity speed = 1.7760 m * viscosity * speed. The studies use this one.
///   kSphere:    Stokes (1851), force = 6 pi radius viscosity speed = 1.2322 m * viscosity *
///   speed, for the sphere with the same surface as a prolate spheroid of semi-axes 0.10 and
///   0.05 m.
class ViscousDrag {
 public:
  enum class Shape { kFlatPlate, kSphere };
  /// Default radius of the sphere that a tool, held like a pen, moves through the fluid.
  static constexpr double kToolRadiusM = 0.01;

  struct Parameters {
    double viscosity_pa_s;  ///< Dynamic viscosity, >= 0; honey has about 10.
    Shape shape = Shape::kFlatPlate;
    double projected_area_m2 = 0.0148;  ///< Of the hand, > 0; used by kFlatPlate.
    double length_m = 0.1;              ///< Characteristic length, > 0; used by kFlatPlate.
    /// Of the spheroid, larger than the semi-minor axis; used by kSphere.
    double semi_major_axis_m = 0.10;
    double semi_minor_axis_m = 0.05;  ///< Of the spheroid, > 0; used by kSphere.
    /// Radius of the sphere, > 0, or 0 to compute it from the spheroid; used by kSphere.
    double radius_m = 0.0;
  };

  /// Throws `Error` naming the field. Not real time.
  explicit ViscousDrag(const Parameters& parameters);

  /// Returns force / (viscosity speed), in metres: 1.7760 or 1.2322 with the default sizes.
  [[nodiscard]] double shape_constant_m() const noexcept { return shape_constant_m_; }

  [[nodiscard]] double damping_n_s_per_m() const noexcept { return damping_n_s_per_m_; }

  /// Returns the magnitude of the force in newtons, which acts against the motion. Real time.
  [[nodiscard]] double drag_n(double speed_m_per_s) const noexcept {
    return damping_n_s_per_m_ * speed_m_per_s;
  }

 private:
  double shape_constant_m_;
  double damping_n_s_per_m_;
};

/// Returns the radius of the sphere with the same surface as a prolate spheroid of these
/// semi-axes.
[[nodiscard]] double equal_surface_radius_m(double semi_major_axis_m, double semi_minor_axis_m);

}  // namespace jnd::core
