#pragma once

#include <string>

#include "analysis/fits/beta_prior.h"

namespace jnd::app {

/// The largest value of a prior's two numbers for a rate of a posterior. A sharper prior would
/// fall between the points of the grid.
inline constexpr double kLargestGridPrior = 1000.0;

/// The help of --lapse-prior, which goes with --posterior.
inline constexpr char kLapsePriorHelp[] =
    "with --posterior: the prior of a free rate r has the density of Beta(A, B), r^(A - 1) "
    "(1 - r)^(B - 1), below 0.5, A and B from 1 to 1000; 1,1 is none. Also tells the medians "
    "without it, with half and with twice its weight";

/// The prior that an option's text "A,B" names; both numbers are from 1 to `largest`. Throws
/// `UsageError` with the option's name.
[[nodiscard]] analysis::BetaPrior beta_prior_of(const std::string& option,
                                                const std::string& text, double largest);

/// "without it", "at half its weight" or "at twice its weight".
[[nodiscard]] std::string prior_weight_words(double weight);

}  // namespace jnd::app
