#pragma once

#include <string_view>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// The whole file.
[[nodiscard]] const ParameterTable& study_table();
/// One table for each stage kind, its `name` being the kind.
[[nodiscard]] const std::vector<const ParameterTable*>& stage_tables();
/// Null for an unknown kind.
[[nodiscard]] const ParameterTable* stage_table(std::string_view kind) noexcept;
/// Every table there is, each once.
[[nodiscard]] const std::vector<const ParameterTable*>& all_tables();

}  // namespace jnd::experiments
