#pragma once

#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// The keys every stage has, in front of its own: `kind`, `name`, `title`, `only_for`.
[[nodiscard]] std::vector<Parameter> stage_parameters(const std::string& kind,
                                                      std::vector<Parameter> own);

/// `medium` and, in the unit of its key, the one value of its quantity; then `own`.
[[nodiscard]] std::vector<Parameter> setting_parameters(std::vector<Parameter> own);

[[nodiscard]] const ParameterTable& block_table();
/// Several blocks whose trials are mixed.
[[nodiscard]] const ParameterTable& interleaved_table();
/// One alternative of a counterbalance.
[[nodiscard]] const ParameterTable& arm_table();
[[nodiscard]] const ParameterTable& questionnaire_table();
/// One question: of a questionnaire, or after every trial of a block.
[[nodiscard]] const ParameterTable& questionnaire_item_table();
/// One answer to choose from.
[[nodiscard]] const ParameterTable& option_table();
/// What a participant brings.
[[nodiscard]] const ParameterTable& participant_field_table();

}  // namespace jnd::experiments
