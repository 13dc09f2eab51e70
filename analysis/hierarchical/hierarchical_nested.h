#pragma once

#include <map>
#include <utility>
#include <vector>

#include "analysis/hierarchical/hierarchical_search.h"

namespace jnd::analysis {

/// Tests a parameter that is on its bound 0 under the null hypothesis, such as a spread or a
/// correlation. Twice the gain of log-likelihood and log prior then follows an equal mixture of
/// 0 and chi-squared with one degree of freedom (Self and Liang 1987). So p is half of that of
/// chi-squared, and 1 at the bound.
struct BoundaryTest {
  double statistic = 0.0, p_value = 1.0;
};
[[nodiscard]] BoundaryTest boundary_test(double log_with, double log_without);

/// Finds the optimum of a model with answers that scatter, with people's own lapse rates, or
/// with both, and the optima of the models nested in it: independent answers, and one lapse
/// rate for everybody. Each search also starts from the optima of its nested models, so that it
/// never ends below them. Not real time.
class NestedOptima {
 public:
  /// `structure` is that of the largest model. `start` is the result of `start_of`. The people
  /// must outlive the object.
  NestedOptima(const std::vector<HierarchicalPerson>& people, HierarchicalStructure structure,
               Eigen::VectorXd start, int num_nodes);

  /// Neither may be true if the largest model does not have it.
  [[nodiscard]] const HierarchicalOptimum& of(bool has_scatter, bool has_own_lapses);

  [[nodiscard]] HierarchicalStructure structure(bool has_scatter, bool has_own_lapses) const;

 private:
  [[nodiscard]] HierarchicalOptimum sought(bool has_scatter, bool has_own_lapses);

  const std::vector<HierarchicalPerson>& people_;
  HierarchicalStructure structure_;
  Eigen::VectorXd start_;
  int num_nodes_;
  std::map<std::pair<bool, bool>, HierarchicalOptimum> found_;
};

}  // namespace jnd::analysis
