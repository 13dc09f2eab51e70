#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "analysis/fits/likelihood_profile.h"

namespace jnd::analysis {

/// The rise of minus the log-likelihood, all other parameters at their optimum, that marks the
/// ends of a 95 % interval. There is one for the slope of a probit line and one for its pse, if
/// the pse is free.
struct CalibratedDrops {
  double slope = kLikelihoodDrop, pse = kLikelihoodDrop;
};

/// A calibration needs at least this many redraws, because a 95 % quantile of fewer is not
/// reliable.
inline constexpr int kFewestCalibrations = 200;

/// Calibrates the rise of minus the log-likelihood for few answers per level. There the
/// likelihood ratio exceeds the limit of chi-squared too often: with five answers at each of
/// eight levels and three parameters, the intervals hold the truth in 91 % of data sets
/// (data/reference/coverage). Answers are therefore redrawn from the fitted line. Half the 95 %
/// quantile of their likelihood ratios, each taken at the fitted line, replaces half the
/// quantile of chi-squared if it is larger (a parametric bootstrap of the ratio's distribution;
/// Davison and Hinkley 1997).
///
/// The line is P(yes) = Phi(X beta). The first column of `design` is the intensity on any
/// scale; its coefficient, the slope, is > 0. With `free_pse` the last column is 1. All other
/// columns belong to nuisance parameters. There are at least two columns. `num_trials` holds
/// the trials of each row. Redraws that are separated count with the limit of their likelihood.
/// Redraws that fall with the intensity have no fit and do not count. The same seed gives the
/// same numbers. Not real time.
[[nodiscard]] CalibratedDrops calibrated_drops(const Eigen::MatrixXd& design,
                                               const Eigen::VectorXd& num_trials,
                                               const Eigen::VectorXd& coefficients,
                                               bool free_pse, int num_redraws,
                                               std::uint64_t seed);

}  // namespace jnd::analysis
