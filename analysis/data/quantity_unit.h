#pragma once

#include <string>

namespace jnd::analysis {

/// Of an intensity of this quantity: "Pa s", "N/m"; "" of a ratio.
[[nodiscard]] inline std::string quantity_unit(const std::string& quantity) {
  if (quantity == "viscosity_pa_s") return "Pa s";
  return quantity == "stiffness_n_per_m" ? "N/m" : "";
}

/// The same as estimates say it: "1" of a ratio.
[[nodiscard]] inline std::string unit_of_quantity(const std::string& quantity) {
  const std::string unit = quantity_unit(quantity);
  return unit.empty() ? "1" : unit;
}

}  // namespace jnd::analysis
