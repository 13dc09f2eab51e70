#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "analysis/mixed/mixed_likelihood.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The largest likelihood of a mixed model over fixed effects and theta together.
struct MixedOptimum {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no optimum; "" if there is one.
  Eigen::VectorXd parameters;
  double log_likelihood = 0.0;
  /// The inverse of the observed information. Directions in which the likelihood is flat have
  /// 0, such as the correlation of an effect that does not differ between groups.
  Eigen::MatrixXd covariance;
  /// The parameter that has no most likely value because answers are separated; -1 if every one
  /// has.
  int unbounded = -1;
};

/// Climbs from `parameters` by BFGS (Nocedal and Wright 2006, ch. 6) to where it comes to rest.
/// `inverse` is the first approximation of the inverse information, and is updated. Returns
/// false if numbers left their range or it took too long. `parameters` are of the order of 1.
[[nodiscard]] bool climb(MixedLikelihood& likelihood, Eigen::VectorXd& parameters,
                         Eigen::MatrixXd& inverse, double& log_likelihood);

/// The fixed effect that has no most likely value because answers are separated: near `at`,
/// where a climb came to rest, the likelihood hardly depends on it. -1 if every one has, and
/// nothing if numbers left their range.
[[nodiscard]] std::optional<int> unbounded_effect(MixedLikelihood& likelihood,
                                                  const Eigen::VectorXd& at, int num_fixed);

/// Climbs, and then takes Newton steps with an information from differences of gradients. A
/// spread of 0 may be a saddle or a minimum of the likelihood. The search leaves such a place
/// in the direction of the strongest upward curvature.
[[nodiscard]] MixedOptimum most_likely(MixedLikelihood& likelihood,
                                       const Eigen::VectorXd& start, int num_fixed);

/// The fixed effects of the model without random effects, by Fisher scoring. They serve as a
/// start.
[[nodiscard]] Eigen::VectorXd fixed_start(const MixedModel& model);

}  // namespace jnd::analysis
