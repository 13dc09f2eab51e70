#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// How well repetitions of the same estimation agree, as in table D.2 of the thesis: for every
/// pair of repetitions Pearson's r over the intensities that both have, of each participant
/// (with Fisher's interval) and on average; and the median of them all.
void add_trial_correlations(ResultsSection& section, const StudyData& data,
                            const BlockDesign& block, const ResultsOptions& options);

/// The same of one participant's trials in the block, "trial_correlation.t1_t2" and so on,
/// where there is one.
[[nodiscard]] std::map<std::string, double> own_trial_correlations(
    const std::vector<core::TrialRow>& trials);

}  // namespace jnd::analysis
