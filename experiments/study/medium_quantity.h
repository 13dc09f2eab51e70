#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// A medium and its one varied quantity, which is the key it is given under.
struct MediumQuantity {
  std::string medium;
  std::string quantity;  ///< "" for free space.
  std::string unit;
  Range range;
  std::string meaning;
};
[[nodiscard]] const std::vector<MediumQuantity>& media();
/// "" for free space and for unknown media.
[[nodiscard]] std::string quantity_of(std::string_view medium);

}  // namespace jnd::experiments
