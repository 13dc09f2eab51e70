#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_model.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

struct HierarchicalOptimum {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no optimum; "" if there is one.
  /// There is no optimum because the likelihood rises without bound.
  bool is_separated = false;
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;  ///< The inverse of the observed information.
  /// The influence of each person (a column) on each parameter: covariance times score. The
  /// mean of the scores, which only a prior keeps from 0, is subtracted.
  Eigen::MatrixXd influence;
  double log_likelihood = 0.0;  ///< The log-likelihood plus the log prior.
};

/// Finds the largest integrated likelihood (times the prior) near `start`. Ceres climbs by
/// Fisher's gradient, with fewer nodes if there are many people. Newton's method follows, with
/// a curvature from differences of that gradient. A loading that ends at 0 is an optimum,
/// because the likelihood is even in it.
[[nodiscard]] HierarchicalOptimum most_likely(const HierarchicalLikelihood& likelihood,
                                              const Eigen::VectorXd& start);

/// An approximate maximum with one parameter held at its value. It is a start for
/// `most_likely`.
[[nodiscard]] Eigen::VectorXd most_likely_with(const HierarchicalLikelihood& likelihood,
                                               const Eigen::VectorXd& start, Eigen::Index held);

/// The derivatives of log-likelihood plus log prior. They are those of the exact integral if
/// there are several nodes, and differences otherwise.
[[nodiscard]] Eigen::VectorXd rise_of(const HierarchicalLikelihood& likelihood,
                                      const Eigen::VectorXd& at);

/// The inverse of the observed information in all parameters except `held`, so it has one row
/// and one column less. It is absent if the likelihood curves upwards in some direction.
[[nodiscard]] std::optional<Eigen::MatrixXd> covariance_without(
    const HierarchicalLikelihood& likelihood, const Eigen::VectorXd& at, Eigen::Index held);

/// Finds the maximum with one parameter held at its value, by Newton's method from a nearby
/// `start`. `inverse` is that of the information near there, as `covariance_without` returns
/// it, or empty. It is computed anew if its steps do not shrink. The result is absent if they
/// never shrink.
[[nodiscard]] std::optional<Eigen::VectorXd> most_likely_near(
    const HierarchicalLikelihood& likelihood, const Eigen::VectorXd& start, Eigen::Index held,
    Eigen::MatrixXd& inverse);

/// The better of two searches, if there is a free lapse rate. The likelihood can have a maximum
/// without lapses beside one with some lapses and steeper curves, and the start alone decides
/// which of them a search finds. The second search therefore starts on the other side of the
/// first one's end, from the best curves there.
[[nodiscard]] HierarchicalOptimum better_optimum(const HierarchicalLikelihood& likelihood,
                                                 const HierarchicalStructure& structure,
                                                 const Eigen::VectorXd& start);

/// Searches with one parameter held, one after the other.
class HeldSearch {
 public:
  /// `even` holds other parameters in which the likelihood is even, such as spreads. If one of
  /// them came to rest at 0 and that is no maximum, the search continues with the values that
  /// `start` has for all of them. The likelihood must outlive the search.
  HeldSearch(const HierarchicalLikelihood& likelihood, std::vector<int> even,
             Eigen::VectorXd start, int held);

  /// The maximum with the held parameter as in `near`. It is absent if there is none.
  [[nodiscard]] std::optional<Eigen::VectorXd> from(Eigen::VectorXd near);

 private:
  [[nodiscard]] bool is_maximum(const Eigen::VectorXd& at) const;

  const HierarchicalLikelihood& likelihood_;
  std::vector<int> even_;
  Eigen::VectorXd start_;
  int held_;
  /// The inverse for `most_likely_near`, kept from search to search.
  Eigen::MatrixXd inverse_;
};

}  // namespace jnd::analysis
