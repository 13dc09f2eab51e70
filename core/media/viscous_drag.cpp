#include "core/media/viscous_drag.h"

#include <cmath>
#include <numbers>

#include "core/require.h"

namespace jnd::core {
namespace {

double shape_constant(const ViscousDrag::Parameters& parameters) {
  if (parameters.shape == ViscousDrag::Shape::kFlatPlate) {
    require(parameters.projected_area_m2 > 0.0, "projected_area_m2", "a number > 0",
            parameters.projected_area_m2);
    require(parameters.length_m > 0.0, "length_m", "a number > 0", parameters.length_m);
    return 12.0 * parameters.projected_area_m2 / parameters.length_m;
  }
  require(parameters.radius_m >= 0.0 && std::isfinite(parameters.radius_m), "radius_m",
          "a finite number >= 0", parameters.radius_m);
  const double radius_m =
      parameters.radius_m > 0.0
          ? parameters.radius_m
          : equal_surface_radius_m(parameters.semi_major_axis_m, parameters.semi_minor_axis_m);
  return 6.0 * std::numbers::pi * radius_m;
}

}  // namespace

ViscousDrag::ViscousDrag(const Parameters& parameters)
    : shape_constant_m_(shape_constant(parameters)),
      damping_n_s_per_m_(shape_constant_m_ * parameters.viscosity_pa_s) {
  require(parameters.viscosity_pa_s >= 0.0 && std::isfinite(damping_n_s_per_m_),
          "viscosity_pa_s", "a finite number >= 0", parameters.viscosity_pa_s);
}

double equal_surface_radius_m(double semi_major_axis_m, double semi_minor_axis_m) {
  require(semi_minor_axis_m > 0.0, "semi_minor_axis_m", "a number > 0", semi_minor_axis_m);
  require(semi_major_axis_m > semi_minor_axis_m, "semi_major_axis_m",
          "a number > semi_minor_axis_m", semi_major_axis_m);
  const double a = semi_minor_axis_m;
  const double c = semi_major_axis_m;
  const double eccentricity = std::sqrt(1.0 - (a * a) / (c * c));
  // The surface of a prolate spheroid is 2 pi a^2 + 2 pi a c asin(e) / e, and that of a sphere
  // 4 pi r^2.
  return std::sqrt(0.5 * (a * a + a * c * std::asin(eccentricity) / eccentricity));
}

}  // namespace jnd::core
