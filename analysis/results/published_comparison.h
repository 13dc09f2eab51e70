#pragma once

#include "analysis/results/predictive_people.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// Adds published values to our estimates of the same name, which are computed in the same way.
/// A published value without such an estimate gets one in the section "as_published", computed
/// by the statistic that the file of published values names. It changes no estimate.
void add_published(StudyResults& results, const StudyData& data, const Published& published,
                   const ResultsOptions& options);

/// The number of simulated studies with which published values are compared.
inline constexpr int kPredictiveStudies = 1000;

/// Compares the published values with studies drawn from these people. Sets
/// `StudyResults::predictive` and `Estimate::predictive`.
void add_predictive(StudyResults& results, const Published& published,
                    const PredictivePeople& people);

}  // namespace jnd::analysis
