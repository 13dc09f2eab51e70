#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Gives every estimate without a value its reason, where whoever made it gave none: that
/// nobody has a value, or that one value has no spread. Nothing is null without a word.
void explain_missing(StudyResults& results);

}  // namespace jnd::analysis
