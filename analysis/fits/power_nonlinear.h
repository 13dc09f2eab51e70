#pragma once

#include <string_view>
#include <vector>

#include "analysis/fits/power_fit.h"

namespace jnd::analysis {

inline constexpr std::string_view kTooFewRows =
    "too few rows: a power law needs two different intensities > 0";
inline constexpr std::string_view kPowerOutOfRange = "k or a exceeds the range of numbers";

/// The least-squares power law through magnitudes, S = exp(log_k) I^a.
struct PowerMinimum {
  FitStatus status = FitStatus::kDegenerate;
  std::string_view reason;  ///< Static; "" at kOk.
  double log_k = 0.0, a = 0.0;
  double largest = 0.0;         ///< Largest |magnitude|, so that no square overflows.
  double sum_of_squares = 0.0;  ///< Sum of squares of the residuals, each over `largest`.
};

/// The global minimum; every intensity is > 0. For each exponent the best k is known; where the
/// sum of squares that is left turns from falling to rising on a grid of exponents, the solver
/// goes downhill.
[[nodiscard]] PowerMinimum power_minimum(const std::vector<Magnitude>& data, Solver solver);

}  // namespace jnd::analysis
