#pragma once

#include <Eigen/Core>
#include <vector>

namespace jnd::analysis {

/// The number of dimensions in which people differ is at most five.
constexpr int kMostRandomEffects = 5;
using RandomEffects = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRandomEffects, 1>;

/// A rule for expectations over independent standard normal numbers, E f(x) = sum w_k f(x_k).
/// It is the Gauss-Hermite rule in each dimension, which is exact for polynomials up to degree
/// 2 n - 1 (Golub and Welsch 1969). One node is the mean alone, which gives Laplace's
/// approximation.
struct GaussHermiteGrid {
  std::vector<RandomEffects> node;
  std::vector<double> weight;  ///< The weight of each node. The weights sum to 1.
};

/// `num_nodes` is 1 to 61 for each dimension, and `num_dimensions` is 1 to kMostRandomEffects.
/// Throws `core::Error` otherwise.
[[nodiscard]] GaussHermiteGrid gauss_hermite_grid(int num_nodes, int num_dimensions);

/// A rule for one standard normal number: the trapezoidal rule with equal steps from -6 to 6.
/// For smooth functions it converges faster than any power of the step, however many modes they
/// have.
struct LapseNodes {
  std::vector<double> deviation;  ///< The values of b, which is standard normal.
  std::vector<double> weight;     ///< The weight of each node. The weights sum to 1.
};

/// The nodes for people with at most `most_answers` answers. The more answers there are, the
/// sharper is the density of the lapse angle v + tau b. A step is 1.6 times the standard
/// deviation of b that this many answers at easy levels would leave if tau were 0.4, and at
/// most 0.3.
[[nodiscard]] LapseNodes lapse_nodes(double most_answers, double lapse_limit);

}  // namespace jnd::analysis
