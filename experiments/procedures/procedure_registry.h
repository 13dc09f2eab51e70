#pragma once

#include <string_view>
#include <vector>

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Returns every procedure; each has a line in the source file. They live as long as the
/// program.
[[nodiscard]] const std::vector<const Procedure*>& procedures();

/// Returns the procedure with this name. Throws `Error` that lists the existing ones.
[[nodiscard]] const Procedure& procedure_named(std::string_view name);

}  // namespace jnd::experiments
