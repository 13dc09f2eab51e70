#pragma once

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// The order of the stimuli of a block.
[[nodiscard]] const ParameterTable& order_table();

}  // namespace jnd::experiments
