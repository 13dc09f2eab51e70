#pragma once

#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Tells what the options assume: that there are no lapses, or as many as are told, and that
/// people's pses are alike, or the reference. The fit's note names it, for its intervals hold
/// only if that is so. And the answers are fitted once more without it (a free lapse rate, a
/// pse of each person's own): where that moves the median person's Weber fraction by a twelfth
/// or more, the value has a caution with both numbers. How often this finds a false assumption
/// is in data/reference/coverage. Pses of people's own are tried with two conditions at most.
/// Does nothing where nothing is assumed or the fit has no value. `answers` and `options`: as
/// given to `fit_hierarchical`. Not real time.
void tell_assumptions(HierarchicalFit& fit, const std::vector<ParticipantAnswers>& answers,
                      const HierarchicalOptions& options);

}  // namespace jnd::analysis
