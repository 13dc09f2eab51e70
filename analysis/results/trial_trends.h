#pragma once

#include <cstdint>
#include <vector>

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// Whether people change over the trials, each in a different direction. The mean of their z
/// does not show this: it is about 0 if some change up and others down.
struct TrendDispersion {
  int num_people = 0;  ///< The number of people whose z is defined.
  /// The sum of their squared z. It is about `num_people` if nobody changes.
  double sum_squares = 0;
  double p_value = 1.0;  ///< One-sided: (1 + redraws with at least this sum) / (all + 1).
};
struct TrendDispersions {
  TrendDispersion drift, learning;
};

/// Tests the dispersion by parametric bootstrap. Everybody's answers are redrawn, each trial at
/// its level, from their own curve with a free pse or, without a curve, from (k + 1/2) / (n +
/// 1) at the level. They are redrawn until z is defined, as in the data. z is that of
/// `trial_trend`. The test requires levels that were fixed beforehand. If answers choose the
/// levels, the orders of answers within a level are not equally likely: in a staircase without
/// any change, z has a mean of 0.16 and a standard deviation of 1.2. The same seed gives the
/// same numbers. `num_redraws` is >= 1. Not real time.
[[nodiscard]] TrendDispersions trend_dispersions(const std::vector<DiscriminationAnswers>& all,
                                                 int num_redraws, std::uint64_t seed);

/// Adds whether answers change over the trials, on average and in each person. The tests are
/// exploratory, and form one family with those of other blocks. If a block's levels followed
/// the answers, it says why there is no test.
void add_trial_trends(ResultsSection& section, const std::vector<DiscriminationAnswers>& all,
                      const BlockDesign& block, const ResultsOptions& options);

}  // namespace jnd::analysis
