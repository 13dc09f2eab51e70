#pragma once

#include <string>

#include "analysis/fits/fit_status.h"
#include "analysis/groups/hierarchical_model.h"

namespace jnd::analysis {

struct HierarchicalOptimum {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< "" where there is an optimum.
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;  ///< Inverse of the observed information.
  /// Of each person, a column, on each parameter: covariance times score. The scores' mean,
  /// which only a prior keeps from 0, is taken off.
  Eigen::MatrixXd influence;
  double log_likelihood = 0.0;  ///< And log prior.
};

/// The largest integrated likelihood (times prior) near `start`: Ceres by Fisher's gradient,
/// then Newton on the rule's own value, whose derivatives are differences of it. A loading that
/// ends at 0 is an optimum there: the likelihood is even in it.
[[nodiscard]] HierarchicalOptimum most_likely(const HierarchicalLikelihood& likelihood,
                                              const Eigen::VectorXd& start);

/// Roughly the largest with one parameter held where it is: a start for the search above.
[[nodiscard]] Eigen::VectorXd most_likely_with(const HierarchicalLikelihood& likelihood,
                                               const Eigen::VectorXd& start, Eigen::Index held);

}  // namespace jnd::analysis
