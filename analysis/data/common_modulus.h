#pragma once

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// Converts the answers of a magnitude estimation into percent of their modulus, so that all
/// later analyses read them alike. Answers relative to a felt standard are divided by its
/// `modulus_value`. Answers in everybody's own numbers are divided by the participant's
/// modulus, which `block` then holds. It is the geometric mean of the participant's answers to
/// the stimuli that all answered (modulus equalisation, Lane, Catania and Stevens 1961).
/// Nothing changes if there is no such stimulus. Answers in percent of water stay as they are.
void bring_to_common_modulus(StudyData& data, BlockDesign& block);

}  // namespace jnd::analysis
