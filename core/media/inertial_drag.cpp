#include "core/media/inertial_drag.h"

#include "core/require.h"

namespace jnd::core {

InertialDrag::InertialDrag(const Parameters& parameters)
    : damping_n_s_per_m_(ViscousDrag({.viscosity_pa_s = parameters.viscosity_pa_s,
                                      .projected_area_m2 = parameters.projected_area_m2,
                                      .length_m = parameters.length_m})
                             .damping_n_s_per_m()),
      max_speed_m_per_s_(kMaxReynolds * parameters.viscosity_pa_s /
                         (parameters.density_kg_per_m3 * parameters.length_m)) {
  require(parameters.density_kg_per_m3 > 0.0, "density_kg_per_m3", "a finite number > 0",
          parameters.density_kg_per_m3);
  const double reynolds_at_1_m_per_s =
      parameters.density_kg_per_m3 * parameters.length_m / parameters.viscosity_pa_s;
  // Without viscosity the product would be 0 times infinity; its limit is 0.
  inertial_n_ = parameters.viscosity_pa_s == 0.0
                    ? 0.0
                    : damping_n_s_per_m_ * 0.15 * std::pow(reynolds_at_1_m_per_s, 0.687);
  require(std::isfinite(inertial_n_), "density_kg_per_m3",
          "a finite number > 0 that gives a finite drag", parameters.density_kg_per_m3);
}

}  // namespace jnd::core
