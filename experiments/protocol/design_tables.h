#pragma once

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// A factor: something that a study varies on purpose.
[[nodiscard]] const ParameterTable& factor_table();
/// A comparison of conditions that is planned before anybody takes part.
[[nodiscard]] const ParameterTable& contrast_table();
/// Planned looks at the data before all have taken part.
[[nodiscard]] const ParameterTable& sequential_table();
/// The levels of a block.
[[nodiscard]] Parameter levels_parameter();

}  // namespace jnd::experiments
