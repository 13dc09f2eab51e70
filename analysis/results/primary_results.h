#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Marks the primary estimates: the one or two numbers of each block that answer its question,
/// and for compared blocks the test by these numbers. A reader looks for them first. Everything
/// else is supplementary: other estimators, sensitivity analyses. A primary test need not be
/// planned; its family says whether it is.
void mark_primary(StudyResults& results, const StudyData& data);

}  // namespace jnd::analysis
