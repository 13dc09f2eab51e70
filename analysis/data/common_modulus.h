#pragma once

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// Answers of a magnitude estimation in percent of what they count in, so that everything after
/// reads them alike: those to a felt standard over its `modulus_value`; those in everybody's
/// own numbers over the participant's modulus, the geometric mean of their answers to the
/// stimuli that all answered (modulus equalisation, Lane, Catania and Stevens 1961), which
/// `block` then has. Nothing where there is no such stimulus. What is in percent of water
/// stays.
void bring_to_common_modulus(StudyData& data, BlockDesign& block);

}  // namespace jnd::analysis
