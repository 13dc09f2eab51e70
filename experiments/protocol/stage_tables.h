#pragma once

#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Returns the keys of every stage (`kind`, `name`, `title`, `only_for`) followed by the
/// stage's own.
[[nodiscard]] std::vector<Parameter> stage_parameters(const std::string& kind,
                                                      std::vector<Parameter> own);

/// Returns `medium`, the value of its quantity under the key with its unit, and then `own`.
[[nodiscard]] std::vector<Parameter> setting_parameters(std::vector<Parameter> own);

[[nodiscard]] const ParameterTable& block_table();
/// Several blocks whose trials are mixed.
[[nodiscard]] const ParameterTable& interleaved_table();
/// One arm of a counterbalance.
[[nodiscard]] const ParameterTable& arm_table();
[[nodiscard]] const ParameterTable& questionnaire_table();
/// One question, of a questionnaire or after every trial of a block.
[[nodiscard]] const ParameterTable& questionnaire_item_table();
/// One answer to choose from.
[[nodiscard]] const ParameterTable& option_table();
/// A property of a participant that is known before the session.
[[nodiscard]] const ParameterTable& participant_field_table();

}  // namespace jnd::experiments
