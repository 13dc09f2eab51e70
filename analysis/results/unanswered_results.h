#pragma once

#include "analysis/data/study_data.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Adds cautions to the sections of blocks in which more than a tenth of a participant's
/// answers were "cannot tell" or missed their deadline. Not real time.
void caution_of_unanswered(StudyResults& results, const StudyData& data);

}  // namespace jnd::analysis
