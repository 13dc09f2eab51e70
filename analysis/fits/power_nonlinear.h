#pragma once

#include <string_view>
#include <vector>

#include "analysis/fits/power_fit.h"

namespace jnd::analysis {

inline constexpr std::string_view kTooFewRows =
    "too few rows: a power law needs two different intensities > 0";
inline constexpr std::string_view kPowerOutOfRange = "k or a exceeds the range of numbers";

/// The least-squares power law S = exp(log_k) I^a through magnitudes.
struct PowerMinimum {
  FitStatus status = FitStatus::kDegenerate;
  std::string_view reason;  ///< A static string; "" if the status is kOk.
  double log_k = 0.0, a = 0.0;
  /// The largest |magnitude|. It scales the residuals, so that no square overflows.
  double largest = 0.0;
  double sum_of_squares = 0.0;  ///< The sum of squared residuals, each divided by `largest`.
};

/// The global minimum. Every intensity is > 0. For each exponent the best k is known. The
/// solver descends wherever the remaining sum of squares turns from falling to rising on a grid
/// of exponents.
[[nodiscard]] PowerMinimum power_minimum(const std::vector<Magnitude>& data, Solver solver);

}  // namespace jnd::analysis
