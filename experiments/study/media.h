#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/media/medium.h"
#include "experiments/study/parameter_table.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// A quantity that says how much of a medium there is, and its key.
struct Quantity {
  std::string name;   ///< "viscosity_pa_s"
  std::string unit;   ///< "Pa s"; "" of a ratio.
  const char* words;  ///< "viscosity"
};

/// Something that can be felt. Its row holds what a study and the loop need to know of the
/// medium. CONTRIBUTING.md lists the other places that a new one may need.
struct Medium {
  std::string name;
  const char* words;        ///< "viscous stokes", for people.
  std::string about;        ///< What it is, for who writes a study; "" for free space.
  std::string quantity;     ///< Name of the one that varies; "" for free space.
  Range range;              ///< Of the quantity.
  std::string meaning;      ///< Of the quantity, for who writes a study.
  bool is_pressed = false;  ///< A surface; a fluid is stroked through.
  /// Other numbers that a study may give for it, each optional and with a default. All surfaces
  /// have `friction_ratio` and all fluids `buoyancy_n` besides.
  std::vector<Parameter> details;
  /// What the haptic loop renders, without buoyancy.
  core::MediumAmounts (*amounts)(const MediumSetting& setting) = nullptr;
};

[[nodiscard]] const std::vector<Medium>& media();
/// Returns null for an unknown medium.
[[nodiscard]] const Medium* find_medium(std::string_view name) noexcept;
/// Returns "" for free space and for unknown media.
[[nodiscard]] std::string quantity_of(std::string_view medium);
/// Whether the medium is a surface that is pressed and not a fluid that is stroked through.
[[nodiscard]] bool is_pressed(std::string_view medium) noexcept;

/// The keys of all `MediumDetails`, each with the media that have it.
[[nodiscard]] const std::vector<Parameter>& medium_details();
/// The value of this key, which `medium_details()` has: as the study gave it, or the default.
[[nodiscard]] double detail_of(const MediumSetting& setting, std::string_view key);

/// Of an intensity of this quantity: "Pa s", "N/m"; "" of a ratio.
[[nodiscard]] std::string quantity_unit(std::string_view quantity);
/// Returns the unit as estimates spell it: "1" for a ratio.
[[nodiscard]] std::string unit_of_quantity(std::string_view quantity);
/// Returns words for the quantity: "viscosity", "scaling factor".
[[nodiscard]] std::string quantity_words(std::string_view quantity);

}  // namespace jnd::experiments
