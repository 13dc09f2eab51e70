#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Marks what answers the question that each block was asked, one or two numbers a block, and
/// of blocks that are compared the test by these numbers: what a reader looks for first.
/// Everything else is beside it: other estimators, sensitivity. A primary test need not be a
/// planned one: its family says what it is.
void mark_primary(StudyResults& results, const StudyData& data);

}  // namespace jnd::analysis
