#pragma once

#include <Eigen/Core>
#include <string>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// Maximum likelihood of P(yes) = Phi(offset + X beta).
struct ProbitRegression {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;         ///< Why there is no fit; "" if there is one.
  bool is_separated = false;  ///< There is none for answers split without overlap.
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;   ///< Inverse of the observed information.
  double log_likelihood = 0.0;  ///< Without binomial coefficients; where separated, near its
                                ///< limit.
};

/// One row of `design` for each count. Concave, so Newton's method from 0 finds the optimum;
/// `degenerate` where there is none (answers separated by some combination of the columns) or
/// where columns depend on one another. `offset`: what is known of z in each row; empty: 0.
/// Throws `core::Error` if the sizes differ.
[[nodiscard]] ProbitRegression fit_probit(const Eigen::MatrixXd& design,
                                          const Eigen::VectorXd& num_yes,
                                          const Eigen::VectorXd& num_trials,
                                          const Eigen::VectorXd& offset = {});

}  // namespace jnd::analysis
