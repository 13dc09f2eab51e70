#pragma once

#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Cautions at every value that hangs on what the options assume: that there are no lapses, or
/// as many as are told, and that people's pses are alike, or the reference. The answers are
/// fitted once more without those assumptions (a free lapse rate, a pse of each person's own);
/// where that moves the median person's Weber fraction by a twelfth or more, the caution tells
/// both numbers. How well this finds false assumptions is in data/reference/coverage. Does
/// nothing where nothing is assumed, where the fit has no value, or where there are too many
/// conditions for pses of people's own. `answers` and `options`: as given to
/// `fit_hierarchical`. Not real time.
void caution_of_assumptions(HierarchicalFit& fit,
                            const std::vector<ParticipantAnswers>& answers,
                            const HierarchicalOptions& options);

}  // namespace jnd::analysis
