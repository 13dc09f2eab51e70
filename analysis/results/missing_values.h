#pragma once

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Gives every estimate without a value a reason if it has none: nobody has a value, or one
/// value has no spread. So no missing number is left unexplained.
void explain_missing(StudyResults& results);

}  // namespace jnd::analysis
