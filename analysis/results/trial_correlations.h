#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// How well repetitions of the same estimation agree, as in table D.2 of the thesis. For every
/// pair of repetitions it adds Pearson's r over the intensities that both have, of each
/// participant (with Fisher's interval) and on average. It also adds the median of all.
void add_trial_correlations(ResultsSection& section, const StudyData& data,
                            const BlockDesign& block, const ResultsOptions& options);

/// The correlations of one participant's trials in the block, by names such as
/// "trial_correlation.t1_t2". Pairs without a correlation are missing.
[[nodiscard]] std::map<std::string, double> own_trial_correlations(
    const std::vector<core::TrialRow>& trials);

}  // namespace jnd::analysis
