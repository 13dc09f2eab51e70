#include "experiments/study/medium_quantity.h"

namespace jnd::experiments {

const std::vector<MediumQuantity>& media() {
  // The upper ends are far beyond any device. They catch a value in the wrong unit: mPa s, or
  // percent instead of a factor.
  static const Range kScale = {0.0, 99.0, false};
  static const Range kViscosity = {0.0, 1000.0, true};
  static const std::vector<MediumQuantity> kMedia = {
      {"free_space", "", "", {}, ""},
      {"water", "scale", "", kScale, "factor on the drag of real water; 1 is water, 0 nothing"},
      {"viscous", "viscosity_pa_s", "Pa s", kViscosity,
       "dynamic viscosity of a thick fluid; honey has about 10"},
      {"viscous_stokes", "viscosity_pa_s", "Pa s", kViscosity,
       "dynamic viscosity, rendered as the drag of a sphere of the hand's surface"},
      {"water_map", "scale", "", kScale,
       "factor on the drag and lift of the study's `force_map`"},
      {"viscous_schiller_naumann", "viscosity_pa_s", "Pa s", kViscosity,
       "dynamic viscosity, with the drag of the fluid's inertia on top"},
      {"viscous_ellipsoid", "viscosity_pa_s", "Pa s", kViscosity,
       "dynamic viscosity, rendered as the drag of an ellipsoid that turns with the hand"},
      {"solid",
       "stiffness_n_per_m",
       "N/m",
       {0.0, 100000.0, true},
       "stiffness of a flat surface against the whole hand"},
  };
  return kMedia;
}

std::string quantity_of(std::string_view medium) {
  for (const MediumQuantity& entry : media()) {
    if (entry.medium == medium) return entry.quantity;
  }
  return "";
}

}  // namespace jnd::experiments
