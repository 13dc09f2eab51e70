#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "analysis/fits/likelihood_profile.h"

namespace jnd::analysis {

/// How far minus the log-likelihood rises, everything else most likely, to the ends of a 95 %
/// interval of a probit line's slope and, where it is free, of its pse.
struct CalibratedDrops {
  double slope = kLikelihoodDrop, pse = kLikelihoodDrop;
};

/// Fewer redraws have no 95 % quantile to speak of.
inline constexpr int kFewestCalibrations = 200;

/// At few answers a level the likelihood ratio exceeds its limit, chi-squared, too often: with
/// five answers at each of eight levels and three parameters the intervals hold the truth in
/// 91 % of sets (data/reference/coverage). So answers are drawn anew from the fitted line, and
/// half the 95 % quantile of the likelihood ratios that those have at the line itself takes the
/// place of half that of chi-squared, where it is larger (a parametric bootstrap of the ratio's
/// distribution; Davison and Hinkley 1997).
///
/// The line is P(yes) = Phi(X beta). The first column of `design` is the intensity, however
/// scaled, of which `coefficients` has the slope > 0; with `free_pse` the last one is 1; the
/// others are parameters of no interest. There are two columns or more. `num_trials`: of each
/// row. Separated redraws count at their limit; redraws that fall have no fit and do not count.
/// The same seed gives the same numbers. Not real time.
[[nodiscard]] CalibratedDrops calibrated_drops(const Eigen::MatrixXd& design,
                                               const Eigen::VectorXd& num_trials,
                                               const Eigen::VectorXd& coefficients,
                                               bool free_pse, int num_redraws,
                                               std::uint64_t seed);

}  // namespace jnd::analysis
