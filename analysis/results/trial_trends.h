#pragma once

#include <cstdint>
#include <vector>

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// Whether people change over the trials, each in their own way, which the mean of their z does
/// not show: where some change up and others down it is about 0.
struct TrendDispersion {
  int num_people = 0;      ///< People of whom a z is defined.
  double sum_squares = 0;  ///< Sum of their z squared: about `num_people` if nobody changes.
  double p_value = 1.0;    ///< One-sided: (1 + redraws with at least this sum) / (all + 1).
};
struct TrendDispersions {
  TrendDispersion drift, learning;
};

/// By parametric bootstrap: everybody's answers are drawn anew, each trial at its level, from
/// their own curve with a free pse, where there is one, else from (k + 1/2) / (n + 1) at the
/// level; and drawn again until a z is defined, as it is in the data. z as `trial_trend` has
/// it. For levels that were fixed beforehand: where answers lead to the levels, not every order
/// of the answers within a level is as likely (a staircase without any change has z with a mean
/// of 0.16 and a standard deviation of 1.2). The same seed gives the same numbers.
/// `num_redraws` >= 1. Not real time.
[[nodiscard]] TrendDispersions trend_dispersions(const std::vector<DiscriminationAnswers>& all,
                                                 int num_redraws, std::uint64_t seed);

/// Adds whether answers change over the trials, in the mean and each person in their own way:
/// exploratory, one family with the other blocks. Of a block whose levels followed the answers
/// it says why there is none.
void add_trial_trends(ResultsSection& section, const std::vector<DiscriminationAnswers>& all,
                      const BlockDesign& block, const ResultsOptions& options);

}  // namespace jnd::analysis
