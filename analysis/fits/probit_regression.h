#pragma once

#include <Eigen/Core>
#include <string>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The maximum-likelihood fit of P(yes) = Phi(offset + X beta).
struct ProbitRegression {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no fit; "" if there is one.
  /// There is no fit because the answers are split without overlap.
  bool is_separated = false;
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;  ///< The inverse of the observed information.
  /// The log-likelihood without binomial coefficients. For separated answers it is near its
  /// limit.
  double log_likelihood = 0.0;
};

/// `design` has one row for each count. The log-likelihood is concave, so Newton's method from
/// 0 finds the optimum. The status is `degenerate` if there is no optimum (some combination of
/// the columns separates the answers) or if the columns are linearly dependent. `offset` is the
/// known part of z in each row; an empty vector means 0. Throws `core::Error` if the sizes
/// differ.
[[nodiscard]] ProbitRegression fit_probit(const Eigen::MatrixXd& design,
                                          const Eigen::VectorXd& num_yes,
                                          const Eigen::VectorXd& num_trials,
                                          const Eigen::VectorXd& offset = {});

}  // namespace jnd::analysis
