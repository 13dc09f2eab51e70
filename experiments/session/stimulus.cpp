#include "experiments/session/stimulus.h"

#include "core/error.h"

namespace jnd::experiments {

core::MediumAmounts amounts_of(const std::string& medium, double intensity) {
  if (medium == "free_space") return core::free_space();
  if (medium == "water") return core::water({.scale = intensity});
  if (medium == "viscous") return core::viscous({.viscosity_pa_s = intensity});
  if (medium == "viscous_stokes") {
    return core::viscous(
        {.viscosity_pa_s = intensity, .shape = core::ViscousDrag::Shape::kSphere});
  }
  if (medium == "solid") {
    // Enough damping to be passive at 1 kHz: more than stiffness times half a period.
    return core::solid(
        {.stiffness_n_per_m = intensity, .damping_n_s_per_m = 0.001 * intensity});
  }
  throw core::Error(
      "medium: expected free_space, water, viscous, viscous_stokes or solid, found " + medium);
}

}  // namespace jnd::experiments
