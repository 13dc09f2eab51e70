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
  std::string unit;   ///< "Pa s"; "" for a ratio.
  std::string words;  ///< "viscosity"
};

/// Something that can be felt. Its row holds everything that the program knows of the medium.
struct Medium {
  std::string name;
  std::string quantity;     ///< Name of its quantity; "" for free space.
  Range range;              ///< Of the quantity.
  std::string meaning;      ///< Meaning of the quantity, for authors of studies.
  bool is_pressed = false;  ///< A surface, which is pressed; a fluid is stroked through.
  /// Returns what the haptic loop renders, without buoyancy.
  core::MediumAmounts (*amounts)(const MediumSetting& setting) = nullptr;
};

[[nodiscard]] const std::vector<Medium>& media();
/// Returns null for an unknown medium.
[[nodiscard]] const Medium* find_medium(std::string_view name) noexcept;
/// Returns "" for free space and for unknown media.
[[nodiscard]] std::string quantity_of(std::string_view medium);
/// Whether the medium is a surface that is pressed and not a fluid that is stroked through.
[[nodiscard]] bool is_pressed(std::string_view medium) noexcept;

/// Returns the unit of this quantity: "Pa s", "N/m", or "" for a ratio.
[[nodiscard]] std::string quantity_unit(std::string_view quantity);
/// Returns the unit as estimates spell it: "1" for a ratio.
[[nodiscard]] std::string unit_of_quantity(std::string_view quantity);
/// Returns words for the quantity: "viscosity", "scaling factor".
[[nodiscard]] std::string quantity_words(std::string_view quantity);

}  // namespace jnd::experiments
