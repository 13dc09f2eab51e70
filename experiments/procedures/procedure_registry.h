#pragma once

#include <string_view>
#include <vector>

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// Every procedure, one line each in the source file; they live as long as the program.
[[nodiscard]] const std::vector<const Procedure*>& procedures();

/// The procedure of that name. Throws `Error` naming those that exist.
[[nodiscard]] const Procedure& procedure_named(std::string_view name);

}  // namespace jnd::experiments
