#pragma once

#include <string>
#include <vector>

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// A fit is marked if less than this share of redrawn answers lies as far from its curve as the
/// answers do.
inline constexpr double kRejectedBelow = 0.05;

/// Adds every participant's own values in a block: the Weber fraction with the pse at the
/// reference (as published) and with a free pse, and the pse. For both fits it adds how often
/// answers redrawn from the curve lie at least as far from it (Wichmann and Hill 2001; `seed`
/// of the options). These show a fraction that absorbs a bias. For the first fit it adds the
/// order effect, if either interval may hold the test. Not real time.
void add_own_values(ResultsSection& section, const std::vector<DiscriminationAnswers>& all,
                    const BlockDesign& block, const ResultsOptions& options);

/// The number of fits with the pse at the reference, and the number of these that the data
/// reject.
struct FitsBorne {
  int num_fits = 0, num_rejected = 0;
};
[[nodiscard]] FitsBorne fits_borne(const ResultsSection& section, const std::string& block);

}  // namespace jnd::analysis
