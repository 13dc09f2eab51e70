#pragma once

#include <map>
#include <utility>
#include <vector>

#include "analysis/hierarchical/hierarchical_search.h"

namespace jnd::analysis {

/// Where a model's one parameter is on its bound 0, as a spread or a correlation may be: twice
/// the gain of log-likelihood and log prior follows 0 and chi-squared with one degree of
/// freedom by halves (Self and Liang 1987), so that p is half of that of chi-squared, and 1 at
/// the bound.
struct BoundaryTest {
  double statistic = 0.0, p_value = 1.0;
};
[[nodiscard]] BoundaryTest boundary_test(double log_with, double log_without);

/// The optimum of a model with answers that scatter, own lapses or both, and those of the
/// models within it: independent answers, one lapse rate for everybody. Each search also starts
/// from the optima of what it holds, so that none of them is above it. Not real time.
class NestedOptima {
 public:
  /// `structure`: of the largest model; `start` as of `start_of`. The people have to outlive
  /// it.
  NestedOptima(const std::vector<HierarchicalPerson>& people, HierarchicalStructure structure,
               Eigen::VectorXd start, int num_nodes);

  /// Neither may be asked for where the largest model has it not.
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
