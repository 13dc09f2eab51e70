#include "core/media/solid_plane.h"

#include <cmath>

#include "core/require.h"

namespace jnd::core {

SolidPlane::SolidPlane(const Parameters& parameters) : parameters_(parameters) {
  require(parameters.stiffness_n_per_m >= 0.0 && std::isfinite(parameters.stiffness_n_per_m),
          "stiffness_n_per_m", "a finite number >= 0", parameters.stiffness_n_per_m);
  require(parameters.damping_n_s_per_m >= 0.0 && std::isfinite(parameters.damping_n_s_per_m),
          "damping_n_s_per_m", "a finite number >= 0", parameters.damping_n_s_per_m);
}

}  // namespace jnd::core
