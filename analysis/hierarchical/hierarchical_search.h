#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_model.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

struct HierarchicalOptimum {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;         ///< "" where there is an optimum.
  bool is_separated = false;  ///< There is none, as the likelihood rises without bound.
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;  ///< Inverse of the observed information.
  /// Of each person, a column, on each parameter: covariance times score. The scores' mean,
  /// which only a prior keeps from 0, is taken off.
  Eigen::MatrixXd influence;
  double log_likelihood = 0.0;  ///< And log prior.
};

/// The largest integrated likelihood (times prior) near `start`: Ceres by Fisher's gradient, of
/// many people with fewer nodes, then Newton's method, whose curvature is differences of that
/// gradient. A loading that ends at 0 is an optimum there: the likelihood is even in it.
[[nodiscard]] HierarchicalOptimum most_likely(const HierarchicalLikelihood& likelihood,
                                              const Eigen::VectorXd& start);

/// Roughly the largest with one parameter held where it is: a start for the search above.
[[nodiscard]] Eigen::VectorXd most_likely_with(const HierarchicalLikelihood& likelihood,
                                               const Eigen::VectorXd& start, Eigen::Index held);

/// Derivatives of log-likelihood and log prior: the exact integral's where there are several
/// nodes, else by differences.
[[nodiscard]] Eigen::VectorXd rise_of(const HierarchicalLikelihood& likelihood,
                                      const Eigen::VectorXd& at);

/// Inverse of the observed information in all parameters but one: a row and a column less.
/// Absent where the likelihood curves upwards along some direction.
[[nodiscard]] std::optional<Eigen::MatrixXd> covariance_without(
    const HierarchicalLikelihood& likelihood, const Eigen::VectorXd& at, Eigen::Index held);

/// The largest with one parameter held where it is, by Newton's method from a `start` near it.
/// `inverse`: of the information thereabouts as of `covariance_without`, or empty; it is
/// renewed where steps by it do not get smaller. Absent where they never do.
[[nodiscard]] std::optional<Eigen::VectorXd> most_likely_near(
    const HierarchicalLikelihood& likelihood, const Eigen::VectorXd& start, Eigen::Index held,
    Eigen::MatrixXd& inverse);

/// The better of two searches where there is a lapse rate. None is a maximum of its own beside
/// one with some lapses and steeper curves, and which of them a single search comes to hangs on
/// nothing but where it starts: the second one starts on the other side of the first one's end,
/// from the best curves there.
[[nodiscard]] HierarchicalOptimum better_optimum(const HierarchicalLikelihood& likelihood,
                                                 const HierarchicalStructure& structure,
                                                 const Eigen::VectorXd& start);

/// Searches with one parameter held, one after the other.
class HeldSearch {
 public:
  /// `even`: other parameters in which the likelihood is even, such as spreads. Where one came
  /// to rest at 0 and that is no maximum, the search goes on from what `start` has of all of
  /// them. The likelihood has to outlive the search.
  HeldSearch(const HierarchicalLikelihood& likelihood, std::vector<int> even,
             Eigen::VectorXd start, int held);

  /// The largest with the held parameter as in `near`. Absent where there is none.
  [[nodiscard]] std::optional<Eigen::VectorXd> from(Eigen::VectorXd near);

 private:
  [[nodiscard]] bool is_maximum(const Eigen::VectorXd& at) const;

  const HierarchicalLikelihood& likelihood_;
  std::vector<int> even_;
  Eigen::VectorXd start_;
  int held_;
  Eigen::MatrixXd inverse_;  ///< As of `most_likely_near`, from search to search.
};

}  // namespace jnd::analysis
