#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "experiments/order/cell.h"

namespace jnd::app {

/// Adds `--field NAME=VALUE`, once for each of the study's participant fields.
void add_field_option(CLI::App& command, std::vector<std::string>& given,
                      const std::string& help);

/// What was given, for a study. Throws `UsageError` for a field or a value that it has not, one
/// given twice, and one that lacks.
[[nodiscard]] experiments::FieldValues fields_given(const experiments::Study& study,
                                                    const std::vector<std::string>& given);

/// The same where all may lack: then what each participant brings is drawn.
[[nodiscard]] experiments::FieldValues fields_or_none(const experiments::Study& study,
                                                      const std::vector<std::string>& given);

}  // namespace jnd::app
