#pragma once

#include <string_view>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Returns the table of the whole file.
[[nodiscard]] const ParameterTable& study_table();
/// Returns one table for each stage kind, whose `name` is the kind.
[[nodiscard]] const std::vector<const ParameterTable*>& stage_tables();
/// Returns null for an unknown kind.
[[nodiscard]] const ParameterTable* stage_table(std::string_view kind) noexcept;
/// Returns every table, each once.
[[nodiscard]] const std::vector<const ParameterTable*>& all_tables();

}  // namespace jnd::experiments
