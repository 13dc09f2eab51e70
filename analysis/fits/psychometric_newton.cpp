#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/fits/psychometric_descent.h"

namespace jnd::analysis {
namespace {

constexpr int kMaxSteps = 500;
constexpr double kLapseScale = 0.1;  ///< A step of the lapse as large as one of ln slope.
constexpr double kLargestRadius = 1e3;
/// Newton's last step is at most this, so that the error left is about its square.
constexpr double kSmallStep = 1e-8;

/// The cost about one curve in steps of like size: of ln slope, z, and lapse / 0.1. Parameters
/// that do not move have no gradient and curvature 1.
struct ScaledCost {
  Eigen::Vector3d scale, gradient;
  Eigen::Matrix3d hessian;
};

ScaledCost scaled(const PsychometricCurve& curve, const PsychometricCost& cost,
                  const FreeParameters& moving) noexcept {
  ScaledCost here;
  here.scale << curve.slope, 1.0, kLapseScale;
  here.gradient = here.scale.cwiseProduct(cost.gradient);
  here.hessian = here.scale.asDiagonal() * cost.hessian * here.scale.asDiagonal();
  for (int parameter = 0; parameter < 3; ++parameter) {
    if (moving[static_cast<std::size_t>(parameter)]) continue;
    here.hessian.row(parameter).setZero();
    here.hessian.col(parameter).setZero();
    here.hessian(parameter, parameter) = 1.0;
    here.gradient(parameter) = 0.0;
  }
  return here;
}

/// Newton's step where the Hessian is positive definite and the step within the radius;
/// otherwise, in the Hessian's own axes, by the magnitude of each curvature, damped until it is
/// within: downhill along every axis.
Eigen::Vector3d trusted_step(const ScaledCost& here, double radius) noexcept {
  const Eigen::LLT<Eigen::Matrix3d> cholesky(here.hessian);
  if (cholesky.info() == Eigen::Success) {
    Eigen::Vector3d step = -cholesky.solve(here.gradient);
    if (step.norm() <= radius) return step;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(here.hessian);
  const Eigen::Vector3d along = eigen.eigenvectors().transpose() * here.gradient;
  const Eigen::Vector3d curvature = eigen.eigenvalues().cwiseAbs().array() + 1e-300;
  const auto damped = [&](double damping) -> Eigen::Vector3d {
    return -along.cwiseQuotient((curvature.array() + damping).matrix());
  };
  double low = 0.0, high = along.norm() / radius;  // Within the radius at `high`.
  if (!(damped(low).norm() <= radius)) {
    for (int halving = 0; halving < 20; ++halving) {
      const double middle =
          low > 0.0 ? std::sqrt(low * high) : 1e-6 * high;  // Curvatures span decades.
      (damped(middle).norm() <= radius ? high : low) = middle;
    }
    low = high;
  }
  return eigen.eigenvectors() * damped(low);
}

/// Slope > 0: at most five times more or less in one step.
double feasible_fraction(double step_of_slope) noexcept {
  if (step_of_slope > 4.0) return 4.0 / step_of_slope;
  if (step_of_slope < -0.8) return -0.8 / step_of_slope;
  return 1.0;
}

}  // namespace

PsychometricOptimum minimised_by_newton(const PsychometricLevels& levels,
                                        PsychometricMethod method, const FreeParameters& free,
                                        const PsychometricCurve& start) noexcept {
  PsychometricOptimum best{start, psychometric_cost(levels, method, start), false};
  const double largest_lapse = levels.ends.largest_lapse();
  double radius = 2.0;
  for (int iteration = 0; iteration < kMaxSteps; ++iteration) {
    const PsychometricCurve& curve = best.curve;
    FreeParameters moving = free;
    // On a bound that the cost presses against, the lapse stays.
    if (curve.lapse <= 0.0 && best.cost.gradient(2) >= 0.0) moving[2] = false;
    if (curve.lapse >= largest_lapse && best.cost.gradient(2) <= 0.0) moving[2] = false;
    ScaledCost here = scaled(curve, best.cost, moving);
    Eigen::Vector3d step = trusted_step(here, radius);
    const double wanted_lapse = curve.lapse + step(2) * kLapseScale;
    const bool onto_bound = moving[2] && (wanted_lapse < 0.0 || wanted_lapse > largest_lapse);
    if (onto_bound) {
      // Go onto the bound, and with the others to where they are best there.
      const double onto = std::clamp(wanted_lapse, 0.0, largest_lapse) - curve.lapse;
      PsychometricCost shifted = best.cost;
      shifted.gradient += best.cost.hessian.col(2) * onto;
      moving[2] = false;
      here = scaled(curve, shifted, moving);
      step = trusted_step(here, radius);
      step(2) = onto / kLapseScale;
    }
    const double fraction = feasible_fraction(step(0));
    step *= fraction;
    const Eigen::Vector3d change = here.scale.cwiseProduct(step);
    PsychometricCurve next = {curve.slope + change(0), curve.offset + change(1),
                              std::max(0.0, curve.lapse + change(2))};
    if (!free[2]) next.lapse = curve.lapse;
    if (onto_bound && fraction == 1.0) next.lapse = wanted_lapse < 0.0 ? 0.0 : largest_lapse;

    const PsychometricCost cost = psychometric_cost(levels, method, next);
    const double gain = best.cost.value - cost.value;
    const double expected =
        -(change.dot(best.cost.gradient) + 0.5 * change.dot(best.cost.hessian * change));
    // Rounding of the cost must not stop the last, small steps; the root is for that of small
    // residuals, which are differences of numbers near 1.
    const double here_cost = std::fabs(best.cost.value);
    const double rounding = 1e-14 * here_cost + 1e-15 * std::sqrt(here_cost) + 1e-30;
    const bool small = step.norm() <= kSmallStep * (1.0 + std::fabs(curve.offset)) &&
                       std::fabs(step(0)) <= kSmallStep;
    if (gain > 0.0 || (gain >= -rounding && std::fabs(expected) <= rounding) ||
        (small && gain >= -100.0 * rounding)) {
      best.curve = next;
      best.cost = cost;
      if (small) {
        best.converged = true;
        return best;
      }
      if (gain > 0.7 * expected) {
        radius = std::min(std::max(radius, 3.0 * step.norm()), kLargestRadius);
      } else if (gain < 0.25 * expected) {
        radius = 0.5 * step.norm();
      }
    } else {
      radius = 0.25 * step.norm();
    }
    if (radius < 1e-12) {
      // Rounding hides what is left to gain: that is as close as the cost can tell.
      best.converged = std::fabs(expected) <= 10.0 * rounding;
      return best;
    }
  }
  return best;
}

}  // namespace jnd::analysis
