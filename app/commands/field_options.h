#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "experiments/order/cell.h"

namespace jnd::app {

/// Adds `--field NAME=VALUE`, which is given once for each of the study's participant fields.
void add_field_option(CLI::App& command, std::vector<std::string>& given,
                      const std::string& help);

/// The values that were given. Throws `UsageError` for a field or a value that the study does
/// not have, for a field that is given twice, and for one that is missing.
[[nodiscard]] experiments::FieldValues fields_given(const experiments::Study& study,
                                                    const std::vector<std::string>& given);

/// The same, but no value at all is allowed, too; then each participant's values are drawn.
[[nodiscard]] experiments::FieldValues fields_or_none(const experiments::Study& study,
                                                      const std::vector<std::string>& given);

}  // namespace jnd::app
