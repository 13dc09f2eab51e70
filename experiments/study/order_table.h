#pragma once

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// In which order the stimuli of a block come.
[[nodiscard]] const ParameterTable& order_table();

}  // namespace jnd::experiments
