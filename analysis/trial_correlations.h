#pragma once

#include "analysis/study_results.h"

namespace jnd::analysis {

/// How well repetitions of the same estimation agree, as in table D.2 of the thesis: for every
/// pair of repetitions Pearson's r over the intensities that both have, of each participant
/// (with Fisher's interval) and on average; and the median of them all.
void add_trial_correlations(ResultsSection& section, const StudyData& data,
                            const BlockDesign& block, const ResultsOptions& options);

}  // namespace jnd::analysis
