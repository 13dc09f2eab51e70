#pragma once

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Noise that masks the sounds of a device.
[[nodiscard]] const ParameterTable& masking_noise_table();
/// A tone that marks a moment.
[[nodiscard]] const ParameterTable& cue_table();
/// These are the keys of a study, or (`of_block`) of a block that replaces them.
[[nodiscard]] Parameter masking_noise_parameter(bool of_block);
[[nodiscard]] Parameter cues_parameter(bool of_block);

}  // namespace jnd::experiments
