#pragma once

#include <string>
#include <vector>

#include "analysis/results/discrimination_answers.h"

namespace jnd::analysis {

/// A fit is marked where redrawn answers lie as far off as these less often than that.
inline constexpr double kRejectedBelow = 0.05;

/// Adds what every participant of a block has of their own: the Weber fraction with the pse at
/// the reference (as published), and with a free pse; the pse; of both fits how often answers
/// redrawn from the curve lie at least as far off it (Wichmann and Hill 2001; `seed` of the
/// options); of the first its order effect, where either interval may hold the test. A fraction
/// that absorbs a bias is told by the last. Not real time.
void add_own_values(ResultsSection& section, const std::vector<DiscriminationAnswers>& all,
                    const BlockDesign& block, const ResultsOptions& options);

/// Of the fits with the pse at the reference: how many there are, and how many of them the data
/// reject.
struct FitsBorne {
  int num_fits = 0, num_rejected = 0;
};
[[nodiscard]] FitsBorne fits_borne(const ResultsSection& section, const std::string& block);

}  // namespace jnd::analysis
