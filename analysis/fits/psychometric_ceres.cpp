#include <algorithm>
#include <cmath>

#include "analysis/fits/ceres_descent.h"
#include "analysis/fits/psychometric_descent.h"

namespace jnd::analysis {
namespace {

/// With lapse = limit sin^2(angle) a lapse on its bound 0 is a stationary point, so the search
/// starts inside.
constexpr double kSmallestAngle = 0.05;
/// A lapse below this is taken to tend to 0, and is held there.
constexpr double kNoLapse = 1e-6;

/// The free parameters as Ceres sees them, in the order slope, offset, lapse. Least squares
/// uses ln slope, in which the cost is smooth. The likelihood is concave in the slope itself,
/// so it uses the slope. It uses an angle for the lapse, limit sin^2(angle), which keeps the
/// lapse in [0, limit] without a bound.
class FreeVector {
 public:
  FreeVector(const PsychometricEnds& ends, const FreeParameters& free,
             const PsychometricCurve& start, bool likelihood)
      : ends_(ends), free_(free), start_(start), likelihood_(likelihood) {}

  [[nodiscard]] std::vector<double> start() const {
    std::vector<double> x;
    if (free_[0]) x.push_back(likelihood_ ? start_.slope : std::log(start_.slope));
    if (free_[1]) x.push_back(start_.offset);
    if (free_[2]) x.push_back(likelihood_ ? start_angle() : start_.lapse);
    return x;
  }

  [[nodiscard]] PsychometricCurve curve(std::span<const double> x) const {
    PsychometricCurve curve = start_;
    std::size_t place = 0;
    if (free_[0]) {
      curve.slope = likelihood_ ? x[place] : std::exp(x[place]);
      ++place;
    }
    if (free_[1]) curve.offset = x[place++];
    if (free_[2]) {
      const double sine = std::sin(x[place]);
      curve.lapse = likelihood_ ? ends_.lapse_limit() * sine * sine : x[place];
    }
    return curve;
  }

  /// Converts derivatives by slope, offset and lapse into derivatives by these parameters.
  void chain(std::span<const double> x, const Eigen::Vector3d& by_curve,
             std::span<double> to) const {
    std::size_t place = 0;
    if (free_[0]) {
      to[place] = likelihood_ ? by_curve(0) : by_curve(0) * std::exp(x[place]);
      ++place;
    }
    if (free_[1]) to[place++] = by_curve(1);
    if (free_[2]) {
      // At a lapse of 0 the derivative by the lapse may be infinite, but that by the angle is
      // 0.
      const double by_angle = ends_.lapse_limit() * std::sin(2.0 * x[place]);
      to[place] = !likelihood_ ? by_curve(2) : by_angle == 0.0 ? 0.0 : by_curve(2) * by_angle;
    }
  }

 private:
  [[nodiscard]] double start_angle() const {
    const double lapse = std::min(start_.lapse, ends_.largest_lapse());
    return std::max(std::asin(std::sqrt(lapse / ends_.lapse_limit())), kSmallestAngle);
  }

  const PsychometricEnds& ends_;
  const FreeParameters& free_;
  const PsychometricCurve& start_;
  bool likelihood_;
};

PsychometricCurve most_likely(const PsychometricLevels& levels, const FreeParameters& free,
                              const PsychometricCurve& start) {
  const FreeVector vector(levels.ends, free, start, true);
  const SmoothCost cost = [&](std::span<const double> x, double& value,
                              std::span<double> gradient) {
    const PsychometricCurve curve = vector.curve(x);
    if (!(curve.slope > 0.0)) return false;
    const PsychometricCost here =
        psychometric_cost(levels, PsychometricMethod::kMaximumLikelihood, curve);
    value = here.value;
    vector.chain(x, here.gradient.head<3>(), gradient);
    return std::isfinite(value) && std::all_of(gradient.begin(), gradient.end(),
                                               [](double part) { return std::isfinite(part); });
  };
  const PsychometricCurve found = vector.curve(ceres_minimum(cost, vector.start()));
  // On its bound the lapse has almost no gradient left but still a part in every step, so it is
  // held at 0 and the search is repeated.
  const bool on_bound = free[2] && !(found.lapse > kNoLapse);
  if (!on_bound) return found;
  return most_likely(levels, {free[0], free[1], false, false},
                     {found.slope, found.offset, 0.0});
}

PsychometricCurve least_squares(const PsychometricLevels& levels, const FreeParameters& free,
                                const PsychometricCurve& start) {
  const FreeVector vector(levels.ends, free, start, false);
  const std::vector<double> first = vector.start();
  SquaresProblem problem;
  const bool at_zero = levels.zero_trials > 0.0;
  problem.num_residuals = static_cast<int>(levels.size()) + (at_zero ? 1 : 0);
  problem.evaluate = [&](std::span<const double> x, std::span<double> residuals,
                         std::span<double> jacobian) {
    const PsychometricCurve curve = vector.curve(x);
    const double low = levels.ends.low(curve.lapse), rise = levels.ends.rise(curve.lapse);
    for (std::size_t level = 0; level < residuals.size(); ++level) {
      // At intensity 0, f is at its lower end.
      Eigen::Vector3d row(0.0, 0.0, levels.ends.low_by_lapse());
      if (level == levels.size()) {
        residuals[level] = low - levels.zero_yes / levels.zero_trials;
      } else {
        const double u = levels.abscissa[level];
        const SigmoidTails tails =
            sigmoid_tails(levels.sigmoid, curve.slope * u + curve.offset);
        residuals[level] = low + rise * tails.lower - levels.proportion(level);
        row << rise * tails.density * u, rise * tails.density,
            levels.ends.by_lapse(tails.lower, tails.upper);
      }
      if (!jacobian.empty()) {
        vector.chain(x, row, jacobian.subspan(level * x.size(), x.size()));
      }
    }
    return std::isfinite(curve.slope) && std::isfinite(curve.offset);
  };
  if (free[2]) {
    problem.bounds.resize(first.size());
    problem.bounds.back() = {0.0, levels.ends.largest_lapse()};
  }
  const PsychometricCurve found = vector.curve(ceres_minimum(problem, first));
  // The steps of Ceres ignore the bound, so it crawls along it. The lapse is held at 0 and the
  // search is repeated.
  const bool on_bound = free[2] && !(found.lapse > kNoLapse);
  if (!on_bound) return found;
  return least_squares(levels, {free[0], free[1], false, false},
                       {found.slope, found.offset, 0.0});
}

/// Whether Newton's method, started at `found`, stayed there: it ended nearby, or the cost is
/// so flat that Ceres saw nothing left to gain.
bool agree(const PsychometricCurve& found, double cost, const PsychometricOptimum& polished) {
  constexpr double kNear = 1e-3, kFlat = 1e-9;
  const PsychometricCurve& curve = polished.curve;
  const bool near =
      std::fabs(std::log(found.slope / curve.slope)) <= kNear &&
      std::fabs(found.offset - curve.offset) <= kNear * (1.0 + std::fabs(curve.offset)) &&
      std::fabs(found.lapse - curve.lapse) <= kNear;
  return near || std::fabs(cost - polished.cost.value) <= kFlat * cost;
}

}  // namespace

PsychometricOptimum minimised_by_ceres(const PsychometricLevels& levels,
                                       PsychometricMethod method, const FreeParameters& free,
                                       const PsychometricCurve& start) {
  const PsychometricCurve found = method == PsychometricMethod::kMaximumLikelihood
                                      ? most_likely(levels, free, start)
                                      : least_squares(levels, free, start);
  PsychometricOptimum polished = minimised_by_newton(levels, method, free, found);
  const double cost = psychometric_cost(levels, method, found).value;
  polished.converged = polished.converged && agree(found, cost, polished);
  return polished;
}

}  // namespace jnd::analysis
