#include "analysis/hierarchical/hierarchical_quadrature.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::analysis {

GaussHermiteGrid gauss_hermite_grid(int num_nodes, int num_dimensions) {
  core::require(num_nodes >= 1 && num_nodes <= 61, "num_nodes", "1 to 61", num_nodes);
  core::require(num_dimensions >= 1 && num_dimensions <= kMostRandomEffects, "num_dimensions",
                "1 to 3", num_dimensions);
  // The nodes are the eigenvalues of the recurrence x He_i = He_{i+1} + i He_{i-1}.
  const Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(num_nodes);
  Eigen::VectorXd beside(num_nodes - 1);
  for (int i = 1; i < num_nodes; ++i) beside(i - 1) = std::sqrt(static_cast<double>(i));
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(diagonal, beside);

  GaussHermiteGrid grid{{RandomEffects(0)}, {1.0}};
  for (int dimension = 0; dimension < num_dimensions; ++dimension) {
    GaussHermiteGrid wider;
    for (std::size_t k = 0; k < grid.node.size(); ++k) {
      for (int i = 0; i < num_nodes; ++i) {
        RandomEffects node(dimension + 1);
        node << grid.node[k], eigen.eigenvalues()(i);
        const double first = eigen.eigenvectors()(0, i);
        wider.node.push_back(node);
        wider.weight.push_back(grid.weight[k] * first * first);
      }
    }
    grid = std::move(wider);
  }
  return grid;
}

LapseNodes lapse_nodes(double most_answers, double lapse_limit) {
  constexpr double kReach = 6.0, kLargestStep = 0.3, kSmallestStep = 0.05, kSpread = 0.4;
  // The standard error of the angle. For n answers that are certain apart from lapses, the
  // information is 4 n limit.
  const double angle_error = 1.0 / std::sqrt(4.0 * lapse_limit * std::max(1.0, most_answers));
  const double step = std::clamp(1.6 * angle_error / kSpread, kSmallestStep, kLargestStep);
  const int num_beside = static_cast<int>(std::ceil(kReach / step));
  LapseNodes nodes;
  double sum = 0.0;
  for (int i = -num_beside; i <= num_beside; ++i) {
    const double deviation = kReach * i / num_beside;
    nodes.deviation.push_back(deviation);
    nodes.weight.push_back(std::exp(-0.5 * deviation * deviation));
    sum += nodes.weight.back();
  }
  for (double& weight : nodes.weight) weight /= sum;
  return nodes;
}

}  // namespace jnd::analysis
