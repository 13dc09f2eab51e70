#include "analysis/fits/likelihood_profile.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "analysis/statistics/root_finding.h"

namespace jnd::analysis {
namespace {

struct Point {
  double cost = std::numeric_limits<double>::infinity();
  std::vector<double> gradient;
};

Point point_at(const SmoothCost& cost, const std::vector<double>& x) {
  Point point{.gradient = std::vector<double>(x.size())};
  if (!cost(x, point.cost, point.gradient) || !std::isfinite(point.cost)) {
    point.cost = std::numeric_limits<double>::infinity();
  }
  return point;
}

/// Newton's method over some of the parameters.
class Newton {
 public:
  /// `free` holds the indices of the parameters that may move.
  Newton(const SmoothCost& cost, std::vector<std::size_t> free)
      : cost_(cost), free_(std::move(free)) {}

  [[nodiscard]] LikelihoodOptimum minimum(std::vector<double> x) const {
    constexpr int kMaxSteps = 200;
    constexpr double kAtRest = 1e-10;
    Point here = point_at(cost_, x);
    for (int i = 0; i < kMaxSteps; ++i) {
      const Eigen::VectorXd step = step_from(x, here);
      if (!step.allFinite()) break;
      if (step.cwiseAbs().maxCoeff() < kAtRest) return {x, here.cost, true};
      if (!walk(x, here, step)) return {x, here.cost, is_small(step)};
    }
    return {x, here.cost, false};
  }

 private:
  [[nodiscard]] Eigen::VectorXd gradient(const Point& point) const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(free_.size()));
    for (std::size_t i = 0; i < free_.size(); ++i) {
      values(static_cast<Eigen::Index>(i)) = point.gradient[free_[i]];
    }
    return values;
  }

  [[nodiscard]] Eigen::MatrixXd hessian(const std::vector<double>& x) const {
    constexpr double kStep = 1e-5;
    const auto size = static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixXd values(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      std::vector<double> above = x;
      std::vector<double> below = x;
      above[free_[static_cast<std::size_t>(i)]] += kStep;
      below[free_[static_cast<std::size_t>(i)]] -= kStep;
      values.col(i) =
          (gradient(point_at(cost_, above)) - gradient(point_at(cost_, below))) / (2.0 * kStep);
    }
    return 0.5 * (values + values.transpose());
  }

  /// A step that leads downhill even if the Hessian is not positive definite.
  [[nodiscard]] Eigen::VectorXd step_from(const std::vector<double>& x,
                                          const Point& here) const {
    constexpr double kLongest = 2.0;
    constexpr double kFlattest = 1e-9;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(hessian(x));
    const Eigen::VectorXd curvature = solver.eigenvalues().cwiseAbs().cwiseMax(kFlattest);
    const Eigen::MatrixXd& axes = solver.eigenvectors();
    const Eigen::VectorXd along = axes.transpose() * gradient(here);
    const Eigen::VectorXd step = -axes * along.cwiseQuotient(curvature);
    const double length = step.norm();
    return length > kLongest ? Eigen::VectorXd(step * (kLongest / length)) : step;
  }

  /// Halves the step until the cost falls. Returns whether any part of the step lowers it.
  bool walk(std::vector<double>& x, Point& here, const Eigen::VectorXd& step) const {
    constexpr int kMaxHalvings = 40;
    double share = 1.0;
    for (int halving = 0; halving < kMaxHalvings; ++halving, share *= 0.5) {
      std::vector<double> next = x;
      for (std::size_t i = 0; i < free_.size(); ++i) {
        next[free_[i]] += share * step(static_cast<Eigen::Index>(i));
      }
      const Point there = point_at(cost_, next);
      if (there.cost < here.cost) {
        x = next;
        here = there;
        return true;
      }
    }
    return false;
  }

  /// Whether the step is so small that rounding of the cost hides what it gains.
  static bool is_small(const Eigen::VectorXd& step) {
    constexpr double kSmall = 1e-6;
    return step.cwiseAbs().maxCoeff() < kSmall;
  }

  const SmoothCost& cost_;
  std::vector<std::size_t> free_;
};

std::vector<std::size_t> places(std::size_t count, std::optional<std::size_t> without = {}) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < count; ++i) {
    if (i != without) all.push_back(i);
  }
  return all;
}

/// The first place where `excess` reaches 0 on a walk with growing steps from 0 toward
/// `farthest`. `excess` is -`drop` at 0.
std::optional<double> crossing(const std::function<double(double)>& excess, double drop,
                               double farthest) {
  double inside = 0.0;
  double excess_inside = -drop;
  for (double step = 0.05; inside < farthest; step *= 1.6) {
    const double outside = std::min(inside + step, farthest);
    const double excess_outside = excess(outside);
    if (excess_outside >= 0.0) {
      const auto close_enough = [](double a, double b) { return std::fabs(b - a) <= 1e-12; };
      const auto [low, high] = root_bracket(excess, {inside, excess_inside},
                                            {outside, excess_outside}, close_enough, 200);
      return 0.5 * (low + high);
    }
    inside = outside;
    excess_inside = excess_outside;
  }
  return std::nullopt;
}

}  // namespace

LikelihoodOptimum likelihood_optimum(const SmoothCost& cost,
                                     const std::vector<std::vector<double>>& starts) {
  std::vector<double> lowest = starts.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& start : starts) {
    const std::vector<double> found = ceres_minimum(cost, start);
    const double value = point_at(cost, found).cost;
    if (value >= least) continue;
    least = value;
    lowest = found;
  }
  return Newton(cost, places(lowest.size())).minimum(lowest);
}

Interval likelihood_ratio_interval(const SmoothCost& cost, const LikelihoodOptimum& optimum,
                                   const std::vector<std::vector<double>>& starts,
                                   std::size_t parameter, double farthest, double drop) {
  const Newton others(cost, places(optimum.at.size(), parameter));
  const auto end = [&](double direction) -> std::optional<double> {
    std::vector<double> last = optimum.at;
    const auto excess = [&](double distance) {
      const double held = optimum.at[parameter] + direction * distance;
      const auto minimum_from = [&](std::vector<double> start) {
        start[parameter] = held;
        return others.minimum(std::move(start));
      };
      LikelihoodOptimum least = minimum_from(last);
      for (const std::vector<double>& start : starts) {
        LikelihoodOptimum other = minimum_from(start);
        if (other.cost < least.cost) least = std::move(other);
      }
      last = least.at;
      // An infinite cost would leave a search for the root without a number.
      constexpr double kMost = 1e6;
      return std::min(least.cost - optimum.cost - drop, kMost);
    };
    const std::optional<double> found = crossing(excess, drop, farthest);
    return found ? std::optional(optimum.at[parameter] + direction * *found) : std::nullopt;
  };
  return {.low = end(-1.0), .high = end(1.0)};
}

}  // namespace jnd::analysis
