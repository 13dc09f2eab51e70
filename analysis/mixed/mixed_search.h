#pragma once

#include <Eigen/Core>
#include <string>

#include "analysis/mixed/mixed_likelihood.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The largest likelihood of a mixed model, over fixed effects and theta together.
struct MixedOptimum {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< "" where it is there.
  Eigen::VectorXd parameters;
  double log_likelihood = 0.0;
  /// Inverse of the observed information; directions in which the likelihood is level, as the
  /// correlation of an effect that does not differ, have none.
  Eigen::MatrixXd covariance;
  /// Parameter that has no most likely value, as for separated answers; -1 for none.
  int unbounded = -1;
};

/// Where BFGS (Nocedal and Wright 2006, ch. 6) comes to rest going uphill from `start`, with
/// `inverse` as the first guess of the inverse of the information, which it renews. False where
/// the numbers left their range or it took too long. `parameters` are of the order of 1.
[[nodiscard]] bool climb(MixedLikelihood& likelihood, Eigen::VectorXd& parameters,
                         Eigen::MatrixXd& inverse, double& log_likelihood);

/// Climbs, then takes Newton's steps with the information itself, as differences of gradients.
/// A level or hollow place, as a spread of 0 may be, is left along its steepest curve.
[[nodiscard]] MixedOptimum most_likely(MixedLikelihood& likelihood,
                                       const Eigen::VectorXd& start, int num_fixed);

/// Fixed effects of the model without random effects, by Fisher's scoring: a start.
[[nodiscard]] Eigen::VectorXd fixed_start(const MixedModel& model);

}  // namespace jnd::analysis
