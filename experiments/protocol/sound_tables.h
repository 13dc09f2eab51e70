#pragma once

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Noise against what could be heard of a device.
[[nodiscard]] const ParameterTable& masking_noise_table();
/// A tone that tells of a moment.
[[nodiscard]] const ParameterTable& cue_table();
/// The keys of a study, and of a block that sounds otherwise.
[[nodiscard]] Parameter masking_noise_parameter(bool of_block);
[[nodiscard]] Parameter cues_parameter(bool of_block);

}  // namespace jnd::experiments
