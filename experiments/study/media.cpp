#include "experiments/study/media.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/for_people.h"

namespace jnd::experiments {
namespace {

using core::for_people;
using core::MediumAmounts;
using core::ViscousDrag;

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> kQuantities = {
      {"scale", "", for_people("scaling factor")},
      {"viscosity_pa_s", "Pa s", for_people("viscosity")},
      {"stiffness_n_per_m", "N/m", for_people("stiffness")},
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
                      .friction_ratio = detail_of(it, "friction_ratio")});
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
       .words = for_people("free space"),
       .amounts = [](const MediumSetting&) { return core::free_space(); }},
      {.name = "water",
       .words = for_people("water"),
       .about = "drag that grows with the square of speed, varied by `scale`.",
       .quantity = "scale",
       .range = kScale,
       .meaning = "factor on the drag of real water; 1 is water, 0 nothing",
       .amounts = [](const MediumSetting& it) { return core::water({.scale = it.intensity}); }},
      {.name = "viscous",
       .words = for_people("viscous"),
       .about = "drag that grows with speed, varied by `viscosity_pa_s`.",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity of a thick fluid; honey has about 10",
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous({.viscosity_pa_s = it.intensity});
           }},
      {.name = "viscous_stokes",
       .words = for_people("viscous stokes"),
       .about = "the same with the constant of a sphere.",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity, rendered as the drag of a sphere of the hand's surface",
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous(
                 {.viscosity_pa_s = it.intensity, .shape = ViscousDrag::Shape::kSphere});
           }},
      {.name = "viscous_sphere",
       .words = for_people("viscous sphere"),
       .about = "the drag of a sphere of `sphere_radius_m`, for a tool with one point.",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity, rendered as the drag of a sphere of `sphere_radius_m`",
       .details = {{.key = "sphere_radius_m",
                    .kind = ValueKind::kNumber,
                    .meaning =
                        "Radius of the sphere that is drawn through the fluid: the tip of a "
                        "tool with one point.",
                    .required = false,
                    .default_json = "0.01",
                    .unit = "m",
                    .range = {0.0, 0.5, true}}},
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous({.viscosity_pa_s = it.intensity,
                                   .shape = ViscousDrag::Shape::kSphere,
                                   .radius_m = detail_of(it, "sphere_radius_m")});
           }},
      {.name = "water_map",
       .words = for_people("water map"),
       .about = "water with the drag and lift of the study's `force_map`.",
       .quantity = "scale",
       .range = kScale,
       .meaning = "factor on the drag and lift of the study's `force_map`",
       .amounts =
           [](const MediumSetting& it) { return core::mapped_water({.scale = it.intensity}); }},
      {.name = "viscous_schiller_naumann",
       .words = for_people("viscous schiller naumann"),
       .about = "viscous with the fluid's inertia, up to a Reynolds number (100 speed / "
                "viscosity, SI units) of 800.",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning = "dynamic viscosity, with the drag of the fluid's inertia on top",
       .amounts =
           [](const MediumSetting& it) {
             return core::viscous_inertial({.viscosity_pa_s = it.intensity});
           }},
      {.name = "viscous_ellipsoid",
       .words = for_people("viscous ellipsoid"),
       .about = "viscous about an ellipsoid that turns with the hand.",
       .quantity = "viscosity_pa_s",
       .range = kViscosity,
       .meaning =
           "dynamic viscosity, rendered as the drag of an ellipsoid that turns with the hand",
       .amounts =
           [](const MediumSetting& it) {
             return core::ellipsoid({.viscosity_pa_s = it.intensity});
           }},
      {.name = "solid",
       .words = for_people("solid"),
       .about = "a flat surface at the height of a fluid's, pressed instead of stroked, varied "
                "by `stiffness_n_per_m`.",
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

const std::vector<Parameter>& medium_details() {
  static const std::vector<Parameter> kDetails = [] {
    Condition fluid = {"medium", {}};
    std::vector<Parameter> details = {
        {.key = "friction_ratio",
         .kind = ValueKind::kNumber,
         .meaning = "Friction of the surface over the force pressing on it.",
         .required = false,
         .default_json = "0.0",
         .range = {0.0, 10.0},
         .only_where = {{"medium", {}}}}};
    for (const Medium& medium : media()) {
      if (!medium.quantity.empty()) {
        Condition& surface = details.front().only_where.front();
        (medium.is_pressed ? surface : fluid).values.push_back(medium.name);
      }
      for (Parameter detail : medium.details) {
        const auto known = std::ranges::find(details, detail.key, &Parameter::key);
        if (known != details.end()) {  // Several media have it, as the first one says.
          known->only_where.front().values.push_back(medium.name);
        } else {
          detail.only_where = {{"medium", {medium.name}}};
          details.push_back(std::move(detail));
        }
      }
    }
    details.push_back(
        {.key = "buoyancy_n",
         .kind = ValueKind::kNumber,
         .meaning =
             "Upward force of the fluid on the whole hand, where it is deeper than 3 cm.",
         .required = false,
         .default_json = "0.0",
         .unit = "N",
         .range = {0.0, 100.0},
         .only_where = {std::move(fluid)}});
    return details;
  }();
  return kDetails;
}

double detail_of(const MediumSetting& setting, std::string_view key) {
  static const std::map<std::string, double, std::less<>> kDefaults = [] {
    std::map<std::string, double, std::less<>> defaults;
    for (const Parameter& detail : medium_details()) {
      defaults[detail.key] = std::stod(detail.default_json);
    }
    return defaults;
  }();
  const auto given = setting.details.find(key);
  return given != setting.details.end() ? given->second : kDefaults.find(key)->second;
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
