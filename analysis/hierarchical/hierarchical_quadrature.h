#pragma once

#include <Eigen/Core>
#include <vector>

namespace jnd::analysis {

/// Dimensions of what differs between people: at most five.
constexpr int kMostRandomEffects = 5;
using RandomEffects = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostRandomEffects, 1>;

/// A rule for expectations over independent standard normal numbers, E f(x) = sum w_k f(x_k):
/// Gauss and Hermite's in each dimension, exact for polynomials up to degree 2 n - 1
/// (Golub and Welsch 1969). One node is the mean alone, which makes Laplace's approximation.
struct GaussHermiteGrid {
  std::vector<RandomEffects> node;
  std::vector<double> weight;  ///< Of each node; they sum to 1.
};

/// `num_nodes` 1 to 61 a dimension, `num_dimensions` 1 to kMostRandomEffects. Throws
/// `core::Error` otherwise.
[[nodiscard]] GaussHermiteGrid gauss_hermite_grid(int num_nodes, int num_dimensions);

/// The same for one number by the trapezoidal rule: equal steps from -6 to 6, which converges
/// faster than any power of the step for what is smooth, however many modes it has.
struct LapseNodes {
  std::vector<double> deviation;  ///< b, standard normal.
  std::vector<double> weight;     ///< Of each; they sum to 1.
};

/// For people with `most_answers` at most, whose lapse angle v + tau b is sharper the more
/// there are: a step is 1.6 of the standard deviations that all of them at easy levels would
/// leave of b, were tau 0.4, and 0.3 or less.
[[nodiscard]] LapseNodes lapse_nodes(double most_answers, double lapse_limit);

}  // namespace jnd::analysis
