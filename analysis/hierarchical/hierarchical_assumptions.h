#pragma once

#include <vector>

#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Reports what the options assume: that there are no lapses or a known share of them, and that
/// people's pses are equal or at the reference. The fit's note names the assumption, because
/// the intervals hold only if it is true. The answers are also fitted once without the
/// assumption, with a free lapse rate and a pse for each person. If that moves the median
/// person's Weber fraction by a twelfth or more, the value gets a caution with both numbers.
/// data/reference/coverage says how often this finds a false assumption. Personal pses are
/// tried with at most two conditions. The function does nothing if nothing is assumed or the
/// fit has no value. `answers` and `options` are those given to `fit_hierarchical`.
/// Not real time.
void tell_assumptions(HierarchicalFit& fit, const std::vector<ParticipantAnswers>& answers,
                      const HierarchicalOptions& options);

}  // namespace jnd::analysis
