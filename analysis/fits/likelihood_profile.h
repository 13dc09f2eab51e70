#pragma once

#include <cstddef>
#include <vector>

#include "analysis/fits/ceres_descent.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// Half the 95 % quantile of chi-squared with one degree of freedom. Minus the log-likelihood
/// rises by this much from its minimum to the ends of a 95 % interval.
inline constexpr double kLikelihoodDrop = 1.9207294103470617;

/// The place where minus the log-likelihood of a few parameters is least.
struct LikelihoodOptimum {
  std::vector<double> at;
  double cost = 0.0;
  bool converged = false;  ///< Whether every parameter is accurate to about 1e-9.
};

/// Descends by Ceres from each of `starts`, and improves the lowest result by Newton's method.
/// The Hessian is made of differences of the gradient. `starts` is not empty. Not real time.
[[nodiscard]] LikelihoodOptimum likelihood_optimum(
    const SmoothCost& cost, const std::vector<std::vector<double>>& starts);

/// The likelihood-ratio interval of one parameter. Its ends lie where the cost, minimised over
/// all other parameters, has risen by `drop`, > 0. The other parameters can have several
/// minima, so they are searched from their last values and from `starts`. An end that is not
/// within `farthest` of the optimum is open. Not real time.
[[nodiscard]] Interval likelihood_ratio_interval(const SmoothCost& cost,
                                                 const LikelihoodOptimum& optimum,
                                                 const std::vector<std::vector<double>>& starts,
                                                 std::size_t parameter, double farthest,
                                                 double drop = kLikelihoodDrop);

}  // namespace jnd::analysis
