#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace jnd::analysis {

/// A smooth cost and its gradient at `x`, which may take any values. False where `x` has left
/// the range of numbers. `gradient` is as long as `x`.
using SmoothCost =
    std::function<bool(std::span<const double> x, double& cost, std::span<double> gradient)>;

/// A sum of squares, as residuals and their derivatives.
struct SquaresProblem {
  int num_residuals = 0;
  /// Residuals at `x` and, row by row, their Jacobian; empty where it is not asked for. False
  /// where `x` has left the range of numbers.
  std::function<bool(std::span<const double> x, std::span<double> residuals,
                     std::span<double> jacobian)>
      evaluate;
  struct Bound {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
  };
  std::vector<Bound> bounds;  ///< One for each parameter, or none at all.
};

/// Where Ceres comes to rest when it goes downhill from `start`: BFGS with a line search.
/// Silent and in the calling thread; the caller judges what was found. Not real time.
[[nodiscard]] std::vector<double> ceres_minimum(const SmoothCost& cost,
                                                std::vector<double> start);

/// The same for a sum of squares, within its bounds: Levenberg and Marquardt.
[[nodiscard]] std::vector<double> ceres_minimum(const SquaresProblem& squares,
                                                std::vector<double> start);

}  // namespace jnd::analysis
