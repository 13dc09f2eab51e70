#include "experiments/study/media.h"

#include <algorithm>

namespace jnd::experiments {
namespace {

using core::MediumAmounts;
using core::ViscousDrag;

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> kQuantities = {
      {"scale", "", "scaling factor"},
      {"viscosity_pa_s", "Pa s", "viscosity"},
      {"stiffness_n_per_m", "N/m", "stiffness"},
  };
  return kQuantities;
}

const Quantity* find_quantity(std::string_view name) noexcept {
  const auto found = std::ranges::find(quantities(), name, &Quantity::name);
  return found == quantities().end() ? nullptr : &*found;
}

/// Damping above stiffness times half a period makes the surface passive at 1 kHz.
MediumAmounts surface(const MediumSetting& it) {
  return core::solid({.stiffness_n_per_m = it.intensity,
                      .damping_n_s_per_m = 0.001 * it.intensity,
                      .friction_ratio = it.friction_ratio});
}

}  // namespace

const std::vector<Medium>& media() {
  // The upper ends are far beyond any device. They catch a value in the wrong unit, such as mPa
  // s, or percent instead of a factor.
  static const Range kScale = {0.0, 99.0, false};
  static const Range kViscosity = {0.0, 1000.0, true};
  static const Range kStiffness = {0.0, 100000.0, true};
  static const std::vector<Medium> kMedia = {
      {.name = "free_space",
       .amounts = [](const MediumSetting&) { return core::free_space(); }},
      {.name = "water",
       .quantity = "scale",
       .range = kScale,
       .meaning = "factor on the drag of real water; 1 is water, 0 nothing",
       .amounts = [](const MediumSetting& it) { return core::water({.scale = it.intensity}); }},
      {.name = "viscous",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity of a thick fluid; honey has about 10",
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous({.viscosity_pa_s = it.intensity});
           }},
      {.name = "viscous_stokes",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity, rendered as the drag of a sphere of the hand's surface",
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous(
                 {.viscosity_pa_s = it.intensity, .shape = ViscousDrag::Shape::kSphere});
           }},
      {.name = "viscous_sphere",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity, rendered as the drag of a sphere of `sphere_radius_m`",
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous({.viscosity_pa_s = it.intensity,
                                   .shape = ViscousDrag::Shape::kSphere,
                                   .radius_m = it.sphere_radius_m});
           }},
      {.name = "water_map",
       .quantity = "scale",
       .range = kScale,
       .meaning = "factor on the drag and lift of the study's `force_map`",
       .amounts =
           [](const MediumSetting& it) { return core::mapped_water({.scale = it.intensity}); }},
      {.name = "viscous_schiller_naumann",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity, with the drag of the fluid's inertia on top",
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous_inertial({.viscosity_pa_s = it.intensity});
           }},
      {.name = "viscous_ellipsoid",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning =
           "dynamic viscosity, rendered as the drag of an ellipsoid that turns with the hand",
       .amounts =
           [](const MediumSetting& it) {
             return core::ellipsoid({.viscosity_pa_s = it.intensity});
           }},
      {.name = "solid",
       .quantity = "stiffness_n_per_m",
       .range = kStiffness,
       .meaning = "stiffness of a flat surface against the whole hand",
       .is_pressed = true,
       .amounts = surface},
  };
  return kMedia;
}

const Medium* find_medium(std::string_view name) noexcept {
  const auto found = std::ranges::find(media(), name, &Medium::name);
  return found == media().end() ? nullptr : &*found;
}

std::string quantity_of(std::string_view medium) {
  const Medium* known = find_medium(medium);
  return known == nullptr ? "" : known->quantity;
}

bool is_pressed(std::string_view medium) noexcept {
  const Medium* known = find_medium(medium);
  return known != nullptr && known->is_pressed;
}

bool Block::is_pressed() const { return experiments::is_pressed(medium); }

bool Block::is_pressed_in(std::string_view interval) const {
  if (interval == "free_space") return false;
  const bool is_standard = interval == "reference" && !standard_medium.empty();
  return experiments::is_pressed(is_standard ? standard_medium : medium);
}

std::string quantity_unit(std::string_view quantity) {
  const Quantity* known = find_quantity(quantity);
  return known == nullptr ? "" : known->unit;
}

std::string unit_of_quantity(std::string_view quantity) {
  const std::string unit = quantity_unit(quantity);
  return unit.empty() ? "1" : unit;
}

std::string quantity_words(std::string_view quantity) {
  if (const Quantity* known = find_quantity(quantity)) return known->words;
  std::string words(quantity);
  std::ranges::replace(words, '_', ' ');
  return words;
}

}  // namespace jnd::experiments
