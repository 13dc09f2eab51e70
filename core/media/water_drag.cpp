#include "core/media/water_drag.h"

#include "core/require.h"

namespace jnd::core {

WaterDrag::WaterDrag(const Parameters& parameters)
    : quadratic_kg_per_m_(0.5 * parameters.scale * parameters.density_kg_per_m3 *
                          parameters.projected_area_m2) {
  require(parameters.scale >= 0.0, "scale", "a finite number >= 0", parameters.scale);
  require(parameters.density_kg_per_m3 > 0.0, "density_kg_per_m3", "a finite number > 0",
          parameters.density_kg_per_m3);
  require(parameters.projected_area_m2 > 0.0, "projected_area_m2", "a finite number > 0",
          parameters.projected_area_m2);
  require(quadratic_kg_per_m_ - quadratic_kg_per_m_ == 0.0, "scale",
          "a finite product with "
          "density_kg_per_m3 and projected_area_m2",
          quadratic_kg_per_m_);
}

}  // namespace jnd::core
