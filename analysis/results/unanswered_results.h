#pragma once

#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Says in the sections of blocks whose answers were often "cannot tell", or often missed their
/// deadline: more than a tenth of somebody's. Not real time.
void caution_of_unanswered(StudyResults& results, const StudyData& data);

}  // namespace jnd::analysis
