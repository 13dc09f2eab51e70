#pragma once

#include "analysis/results/predictive_people.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Puts published values beside our estimates of the same name, which are computed as they were
/// published; what no estimate is computed like gets one of its own, in a section
/// "as_published", by the statistic that the file of published values names. Moves no estimate.
void add_published(StudyResults& results, const StudyData& data, const Published& published,
                   const ResultsOptions& options);

/// Simulated studies that published values are compared with.
inline constexpr int kPredictiveStudies = 1000;

/// Holds the published values against studies drawn from these people. Sets
/// `StudyResults::predictive` and `Estimate::predictive`.
void add_predictive(StudyResults& results, const Published& published,
                    const PredictivePeople& people);

}  // namespace jnd::analysis
