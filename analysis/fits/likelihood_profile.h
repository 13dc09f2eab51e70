#pragma once

#include <cstddef>
#include <vector>

#include "analysis/fits/ceres_descent.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// Half the 95 % quantile of chi-squared with one degree of freedom: by so much does minus a
/// log-likelihood rise from its least to the ends of a 95 % interval.
inline constexpr double kLikelihoodDrop = 1.9207294103470617;

/// Where minus a log-likelihood of a few parameters is least.
struct LikelihoodOptimum {
  std::vector<double> at;
  double cost = 0.0;
  bool converged = false;  ///< A minimum to about 1e-9 in every parameter.
};

/// Downhill from each of `starts` by Ceres; the lowest is mended by Newton's method, whose
/// Hessian is made of differences of the gradient. `starts` is not empty. Not real time.
[[nodiscard]] LikelihoodOptimum likelihood_optimum(
    const SmoothCost& cost, const std::vector<std::vector<double>>& starts);

/// The likelihood-ratio interval of one parameter: where the cost, least over all others, has
/// risen by `drop`, > 0. The others are
/// sought from where they were before and from `starts`, for they can have several minima. An
/// end that is not within `farthest` of the optimum is open. Not real time.
[[nodiscard]] Interval likelihood_ratio_interval(const SmoothCost& cost,
                                                 const LikelihoodOptimum& optimum,
                                                 const std::vector<std::vector<double>>& starts,
                                                 std::size_t parameter, double farthest,
                                                 double drop = kLikelihoodDrop);

}  // namespace jnd::analysis
