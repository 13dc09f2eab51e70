#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {
namespace {

constexpr int kMaxIterations = 200;
constexpr double kLargestLapse = 0.5 - 1e-9;
constexpr double kLargestSlopeRatio = 5.0;  ///< Of one step, either way.
/// Newton's last step is at most this, so that the error left is about its square.
constexpr double kSmallStep = 1e-8;

/// -(Hessian)^-1 gradient over the moving parameters; where the Hessian is not positive
/// definite, its eigenvalues by their magnitude, so that the step still goes downhill.
Eigen::Vector3d newton_step(const PsychometricCost& cost,
                            const FreeParameters& moving) noexcept {
  Eigen::Matrix3d hessian = cost.hessian;
  Eigen::Vector3d gradient = cost.gradient;
  for (int parameter = 0; parameter < 3; ++parameter) {
    if (moving[static_cast<std::size_t>(parameter)]) continue;
    hessian.row(parameter).setZero();
    hessian.col(parameter).setZero();
    hessian(parameter, parameter) = 1.0;
    gradient(parameter) = 0.0;
  }
  const Eigen::LLT<Eigen::Matrix3d> cholesky(hessian);
  if (cholesky.info() == Eigen::Success) {
    const Eigen::Vector3d step = -cholesky.solve(gradient);
    if (step.allFinite() && step.dot(gradient) <= 0.0) return step;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(hessian);
  const double floor = 1e-8 * eigen.eigenvalues().cwiseAbs().maxCoeff() + 1e-300;
  const Eigen::Vector3d curvature = eigen.eigenvalues().cwiseAbs().cwiseMax(floor);
  return -eigen.eigenvectors() *
         (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(curvature);
}

/// The whole step, shortened so that the slope stays > 0.
double feasible_fraction(const PsychometricCurve& curve, const Eigen::Vector3d& step) noexcept {
  const double most = (kLargestSlopeRatio - 1.0) * curve.slope;
  const double least = -(1.0 - 1.0 / kLargestSlopeRatio) * curve.slope;
  double fraction = 1.0;
  if (step(0) > most) fraction = most / step(0);
  if (step(0) < least) fraction = least / step(0);
  return fraction;
}

bool is_small(const PsychometricCurve& curve, const Eigen::Vector3d& step) noexcept {
  return std::fabs(step(0)) <= kSmallStep * curve.slope &&
         std::fabs(step(1)) <= kSmallStep * (1.0 + std::fabs(curve.offset)) &&
         std::fabs(step(2)) <= kSmallStep * curve.lapse + 1e-15;
}

}  // namespace

PsychometricOptimum minimised(const PsychometricLevels& levels, PsychometricMethod method,
                              const FreeParameters& free,
                              const PsychometricCurve& start) noexcept {
  PsychometricOptimum best{start, psychometric_cost(levels, method, start), false};
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    FreeParameters moving = free;
    // On a bound that the cost presses against, the lapse stays.
    if (best.curve.lapse <= 0.0 && best.cost.gradient(2) >= 0.0) moving[2] = false;
    if (best.curve.lapse >= kLargestLapse && best.cost.gradient(2) <= 0.0) moving[2] = false;
    Eigen::Vector3d step = newton_step(best.cost, moving);
    const double wanted_lapse = best.curve.lapse + step(2);
    if (wanted_lapse < 0.0 || wanted_lapse > kLargestLapse) {
      // Go onto the bound, and with the others to where they are best there.
      const double onto = std::clamp(wanted_lapse, 0.0, kLargestLapse) - best.curve.lapse;
      PsychometricCost shifted = best.cost;
      shifted.gradient += best.cost.hessian.col(2) * onto;
      moving[2] = false;
      step = newton_step(shifted, moving);
      step(2) = onto;
    }
    double fraction = feasible_fraction(best.curve, step);
    const bool last = fraction == 1.0 && is_small(best.curve, step);
    bool moved = false;
    for (int halving = 0; halving < 40 && !moved; ++halving, fraction *= 0.5) {
      PsychometricCurve next = {best.curve.slope + fraction * step(0),
                                best.curve.offset + fraction * step(1),
                                std::max(0.0, best.curve.lapse + fraction * step(2))};
      if (wanted_lapse < 0.0 && fraction == 1.0) next.lapse = 0.0;
      const PsychometricCost cost = psychometric_cost(levels, method, next);
      // Rounding of the cost must not stop the last, small steps.
      const double slack = 1e-14 * std::fabs(best.cost.value) + 1e-30;
      if (!(cost.value <= best.cost.value + (last ? 100.0 * slack : slack))) continue;
      best.curve = next;
      best.cost = cost;
      moved = true;
    }
    if (!moved) {
      // Rounding hides what is left to gain: that is as close as the cost can tell.
      best.converged =
          std::fabs(step.dot(best.cost.gradient)) <= 1e-13 * std::fabs(best.cost.value) + 1e-30;
      return best;
    }
    if (last) {
      best.converged = true;
      return best;
    }
  }
  return best;
}

}  // namespace jnd::analysis
