#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/fits/normal_tail.h"
#include "analysis/fits/psychometric_descent.h"

namespace jnd::analysis {
namespace {

constexpr int kMaxSteps = 500;
/// A step of this size in a rate counts as much as a step of 1 in ln slope.
constexpr double kRateScale = 0.1;
constexpr double kLargestRadius = 1e3;
/// Newton's last step is at most this large, so the remaining error is about its square.
constexpr double kSmallStep = 1e-8;

/// The number of parameters that may move. With `kSize` 3 the guess rate is known.
template <int kSize>
using Steps = Eigen::Matrix<double, kSize, 1>;
template <int kSize>
using Curvatures = Eigen::Matrix<double, kSize, kSize>;

/// The cost near one curve, in steps of similar size: of ln slope, of z, and of rates divided
/// by 0.1. Parameters that do not move have gradient 0 and curvature 1.
template <int kSize>
struct ScaledCost {
  Steps<kSize> scale, gradient;
  Curvatures<kSize> hessian;
};

template <int kSize>
ScaledCost<kSize> scaled(const PsychometricCurve& curve, const Steps<kSize>& gradient,
                         const Curvatures<kSize>& hessian,
                         const FreeParameters& moving) noexcept {
  ScaledCost<kSize> here;
  here.scale.setConstant(kRateScale);
  here.scale(0) = curve.slope;
  here.scale(1) = 1.0;
  here.gradient = here.scale.cwiseProduct(gradient);
  here.hessian = here.scale.asDiagonal() * hessian * here.scale.asDiagonal();
  for (int parameter = 0; parameter < kSize; ++parameter) {
    if (moving[static_cast<std::size_t>(parameter)]) continue;
    here.hessian.row(parameter).setZero();
    here.hessian.col(parameter).setZero();
    here.hessian(parameter, parameter) = 1.0;
    here.gradient(parameter) = 0.0;
  }
  return here;
}

/// Newton's step if the Hessian is positive definite and the step is within the radius.
/// Otherwise the step is taken in the Hessian's own axes, divided by the magnitude of each
/// curvature, and damped until it is within the radius. It then leads downhill along every
/// axis.
template <int kSize>
Steps<kSize> trusted_step(const ScaledCost<kSize>& here, double radius) noexcept {
  const Eigen::LLT<Curvatures<kSize>> cholesky(here.hessian);
  if (cholesky.info() == Eigen::Success) {
    Steps<kSize> step = -cholesky.solve(here.gradient);
    if (step.norm() <= radius) return step;
  }
  const Eigen::SelfAdjointEigenSolver<Curvatures<kSize>> eigen(here.hessian);
  const Steps<kSize> along = eigen.eigenvectors().transpose() * here.gradient;
  const Steps<kSize> curvature = eigen.eigenvalues().cwiseAbs().array() + 1e-300;
  const auto damped = [&](double damping) -> Steps<kSize> {
    return -along.cwiseQuotient((curvature.array() + damping).matrix());
  };
  // With the damping `high` the step is within the radius.
  double low = 0.0, high = along.norm() / radius;
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

/// The fraction of a step that keeps the slope > 0. One step changes it by a factor of at most
/// five.
double feasible_fraction(double step_of_slope) noexcept {
  if (step_of_slope > 4.0) return 4.0 / step_of_slope;
  if (step_of_slope < -0.8) return -0.8 / step_of_slope;
  return 1.0;
}

template <int kSize>
PsychometricOptimum minimised(const PsychometricLevels& levels, PsychometricMethod method,
                              const FreeParameters& free,
                              const PsychometricCurve& start) noexcept {
  PsychometricOptimum best{start, psychometric_cost(levels, method, start), false};
  const std::array<double, 4> largest = {0.0, 0.0, levels.ends.largest_lapse(),
                                         levels.ends.largest_guess()};
  double radius = 2.0;
  for (int iteration = 0; iteration < kMaxSteps; ++iteration) {
    const PsychometricCurve& curve = best.curve;
    const std::array<double, 4> at = {curve.slope, curve.offset, curve.lapse, curve.guess};
    Steps<kSize> gradient = best.cost.gradient.template head<kSize>();
    const Curvatures<kSize> hessian = best.cost.hessian.template topLeftCorner<kSize, kSize>();
    FreeParameters moving = free;
    for (std::size_t rate = 2; rate < kSize; ++rate) {
      // A rate stays on its bound if the cost presses against it.
      const double by_rate = gradient(static_cast<int>(rate));
      if (at[rate] <= 0.0 && by_rate >= 0.0) moving[rate] = false;
      if (at[rate] >= largest[rate] && by_rate <= 0.0) moving[rate] = false;
    }
    ScaledCost<kSize> here = scaled<kSize>(curve, gradient, hessian, moving);
    Steps<kSize> step = trusted_step<kSize>(here, radius);
    std::array<double, 4> onto = {};  // How far the rates that meet a bound move.
    std::array<bool, 4> onto_bound = {};
    for (std::size_t rate = kSize - 1; rate >= 2; --rate) {
      const int place = static_cast<int>(rate);
      const double wanted = at[rate] + step(place) * kRateScale;
      if (!moving[rate] || (wanted >= 0.0 && wanted <= largest[rate])) continue;
      // Move this rate onto its bound, and the others to where they are best then.
      onto_bound[rate] = true;
      onto[rate] = std::clamp(wanted, 0.0, largest[rate]) - at[rate];
      gradient += hessian.col(place) * onto[rate];
      moving[rate] = false;
      here = scaled<kSize>(curve, gradient, hessian, moving);
      step = trusted_step<kSize>(here, radius);
      for (std::size_t other = rate; other < kSize; ++other) {
        if (onto_bound[other]) step(static_cast<int>(other)) = onto[other] / kRateScale;
      }
    }
    const double fraction = feasible_fraction(step(0));
    step *= fraction;
    const Steps<kSize> change = here.scale.cwiseProduct(step);
    PsychometricCurve next = {curve.slope + change(0), curve.offset + change(1), curve.lapse,
                              curve.guess};
    for (std::size_t rate = 2; rate < kSize; ++rate) {
      if (!free[rate]) continue;
      double value = std::clamp(at[rate] + change(static_cast<int>(rate)), 0.0,
                                std::max(at[rate], largest[rate]));
      if (onto_bound[rate] && fraction == 1.0) value = onto[rate] < 0.0 ? 0.0 : largest[rate];
      (rate == 2 ? next.lapse : next.guess) = value;
    }

    const PsychometricCost cost = psychometric_cost(levels, method, next);
    const double gain = best.cost.value - cost.value;
    const double expected = -(change.dot(best.cost.gradient.template head<kSize>()) +
                              0.5 * change.dot(hessian * change));
    // Rounding of the cost must not stop the last small steps. The root accounts for small
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
      // Rounding hides what is left to gain, so the cost cannot tell a better curve.
      best.converged = std::fabs(expected) <= 10.0 * rounding;
      return best;
    }
  }
  return best;
}

/// The minimum of minus the log-likelihood without lapses and guesses, which is convex in slope
/// and offset. Its gradient is 0 only at the minimum, so plain Newton steps suffice near it.
/// The result is absent if the steps do not shrink at once.
std::optional<PsychometricCurve> convex_minimum(const PsychometricLevels& levels, bool free_pse,
                                                const PsychometricCurve& start) noexcept {
  constexpr int kMostSteps = 20;
  PsychometricCurve curve = start;
  double last_gain = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < kMostSteps; ++iteration) {
    double by_slope = 0.0, by_offset = 0.0, slope_slope = 0.0, slope_offset = 0.0,
           offset_offset = 0.0;
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const double u = levels.abscissa[level], yes = levels.num_yes[level];
      const double no = levels.num_trials[level] - yes;
      const double z = curve.slope * u + curve.offset;
      const MillsRatios mills = mills_ratios(z);
      const double by_z = yes * mills.lower - no * mills.upper;
      const double bend =
          yes * mills.lower * (mills.lower + z) + no * mills.upper * (mills.upper - z);
      by_slope += by_z * u;
      slope_slope += bend * u * u;
      by_offset += by_z;
      slope_offset += bend * u;
      offset_offset += bend;
    }
    double slope_step = by_slope / slope_slope, offset_step = 0.0;
    if (free_pse) {
      const double determinant = slope_slope * offset_offset - slope_offset * slope_offset;
      slope_step = (by_slope * offset_offset - by_offset * slope_offset) / determinant;
      offset_step = (by_offset * slope_slope - by_slope * slope_offset) / determinant;
    }
    const double gain = slope_step * by_slope + offset_step * by_offset;
    curve.slope += slope_step;
    curve.offset += offset_step;
    if (!(gain >= 0.0 && gain < last_gain && curve.slope > 0.0)) return std::nullopt;
    if (std::fabs(slope_step) <= kSmallStep * curve.slope &&
        std::fabs(offset_step) <= kSmallStep * (1.0 + std::fabs(curve.offset))) {
      return curve;
    }
    last_gain = gain;
  }
  return std::nullopt;
}

bool is_convex(const PsychometricLevels& levels, PsychometricMethod method,
               const FreeParameters& free, const PsychometricCurve& start) noexcept {
  return method == PsychometricMethod::kMaximumLikelihood && free[0] &&
         levels.sigmoid == Sigmoid::kNormal && levels.ends.are_bare(free[2]) && !free[3] &&
         start.lapse == 0.0;
}

}  // namespace

PsychometricOptimum minimised_by_newton(const PsychometricLevels& levels,
                                        PsychometricMethod method, const FreeParameters& free,
                                        const PsychometricCurve& start) noexcept {
  if (is_convex(levels, method, free, start)) {
    if (const auto curve = convex_minimum(levels, free[1], start)) {
      return {*curve, psychometric_cost(levels, method, *curve), true};
    }
  }
  return free[3] ? minimised<4>(levels, method, free, start)
                 : minimised<3>(levels, method, free, start);
}

}  // namespace jnd::analysis
