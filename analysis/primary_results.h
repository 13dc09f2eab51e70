#pragma once

#include "analysis/study_results.h"

namespace jnd::analysis {

/// Marks what answers the question that each block was asked, one or two numbers a block, and
/// the tests planned between blocks: what a reader looks for first. Everything else is beside
/// it: other estimators, sensitivity, exploration.
void mark_primary(StudyResults& results, const StudyData& data);

}  // namespace jnd::analysis
