#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/media/medium.h"
#include "experiments/study/parameter_table.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// How much there is of a medium, and the key that it is given under.
struct Quantity {
  std::string name;   ///< "viscosity_pa_s"
  std::string unit;   ///< "Pa s"; "" of a ratio.
  std::string words;  ///< "viscosity"
};

/// What can be felt, a row each: whatever the program knows of a medium stands in it.
struct Medium {
  std::string name;
  std::string quantity;     ///< Name of the one that varies; "" for free space.
  Range range;              ///< Of the quantity.
  std::string meaning;      ///< Of the quantity, for who writes a study.
  bool is_pressed = false;  ///< A surface; a fluid is stroked through.
  /// What the haptic loop renders, without buoyancy.
  core::MediumAmounts (*amounts)(const MediumSetting& setting) = nullptr;
};

[[nodiscard]] const std::vector<Medium>& media();
/// Null for an unknown one.
[[nodiscard]] const Medium* find_medium(std::string_view name) noexcept;
/// "" for free space and for unknown media.
[[nodiscard]] std::string quantity_of(std::string_view medium);
/// Whether it is a surface that is pressed, not a fluid that is stroked through.
[[nodiscard]] bool is_pressed(std::string_view medium) noexcept;

/// Of an intensity of this quantity: "Pa s", "N/m"; "" of a ratio.
[[nodiscard]] std::string quantity_unit(std::string_view quantity);
/// The same as estimates say it: "1" of a ratio.
[[nodiscard]] std::string unit_of_quantity(std::string_view quantity);
/// "viscosity", "scaling factor": what varies.
[[nodiscard]] std::string quantity_words(std::string_view quantity);

}  // namespace jnd::experiments
