#pragma once

#include <string>

namespace jnd::analysis {

/// Of an intensity of this quantity, as estimates say it: "Pa s", "N/m", "1".
[[nodiscard]] inline std::string unit_of_quantity(const std::string& quantity) {
  if (quantity == "viscosity_pa_s") return "Pa s";
  return quantity == "stiffness_n_per_m" ? "N/m" : "1";
}

}  // namespace jnd::analysis
