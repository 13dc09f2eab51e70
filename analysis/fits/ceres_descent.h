#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace jnd::analysis {

/// Computes a smooth cost and its gradient at any `x`. It returns false where `x` has left the
/// range of numbers. `gradient` is as long as `x`.
using SmoothCost =
    std::function<bool(std::span<const double> x, double& cost, std::span<double> gradient)>;

/// A sum of squares, given by its residuals and their derivatives.
struct SquaresProblem {
  int num_residuals = 0;
  /// Computes the residuals at `x` and their Jacobian, stored row by row. An empty `jacobian`
  /// is not asked for. It returns false where `x` has left the range of numbers.
  std::function<bool(std::span<const double> x, std::span<double> residuals,
                     std::span<double> jacobian)>
      evaluate;
  struct Bound {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  std::vector<Bound> bounds;  ///< One bound for each parameter, or none at all.
};

/// The point where Ceres comes to rest when it descends from `start` by BFGS with a line
/// search. Ceres prints nothing and uses only the calling thread. The caller must judge what
/// was found. Not real time.
[[nodiscard]] std::vector<double> ceres_minimum(const SmoothCost& cost,
                                                std::vector<double> start);

/// The same for a sum of squares within its bounds, by the method of Levenberg and Marquardt.
[[nodiscard]] std::vector<double> ceres_minimum(const SquaresProblem& squares,
                                                std::vector<double> start);

}  // namespace jnd::analysis
