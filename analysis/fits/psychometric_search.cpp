#include "analysis/fits/psychometric_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "analysis/fits/psychometric_limits.h"

namespace jnd::analysis {
namespace {

using enum PsychometricMethod;
constexpr std::string_view kRidge = "not identified: many curves fit equally well";

/// The error that rounding may cause in a cost. The root accounts for small residuals, which
/// are differences of numbers near 1.
double rounding(double cost) noexcept { return 1e-13 * cost + 1e-15 * std::sqrt(cost) + 1e-26; }

/// Newton's first step from slope 0. It is close to the optimum unless the answers are nearly
/// separated.
PsychometricCurve concave_start(const PsychometricLevels& levels, bool free_pse) noexcept {
  double yes = 0.0, trials = 0.0, moment = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    yes += levels.num_yes[level];
    trials += levels.num_trials[level];
    moment += levels.num_trials[level] * levels.abscissa[level];
  }
  const double mean = free_pse ? moment / trials : 0.0;
  double squares = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double distance = levels.abscissa[level] - mean;
    squares += levels.num_trials[level] * distance * distance;
  }
  const double z = free_pse ? sigmoid_quantile(levels.sigmoid, yes / trials) : 0.0;
  const double slope =
      rise_of_answers(levels, free_pse) / (sigmoid_tails(levels.sigmoid, z).density * squares);
  return {slope, z - slope * mean, 0.0};
}

/// Whether the moving parameters cannot be told apart, judged by the smallest eigenvalue of the
/// scaled Hessian.
template <int kSize>
bool is_ridge(const PsychometricOptimum& optimum, const FreeParameters& free) {
  using Square = Eigen::Matrix<double, kSize, kSize>;
  FreeParameters moving = free;
  if (optimum.curve.lapse <= 0.0) moving[2] = false;
  if (optimum.curve.guess <= 0.0) moving[3] = false;
  Square scaled = Square::Identity();
  const Square hessian = optimum.cost.hessian.template topLeftCorner<kSize, kSize>();
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      if (row == column || !moving[static_cast<std::size_t>(row)] ||
          !moving[static_cast<std::size_t>(column)]) {
        continue;
      }
      scaled(row, column) =
          hessian(row, column) / std::sqrt(hessian(row, row) * hessian(column, column));
    }
  }
  const Eigen::SelfAdjointEigenSolver<Square> eigen(scaled, Eigen::EigenvaluesOnly);
  return !(eigen.eigenvalues()(0) > 1e-12);
}

bool is_ridge(const PsychometricOptimum& optimum, const FreeParameters& free) {
  return free[3] ? is_ridge<4>(optimum, free) : is_ridge<3>(optimum, free);
}

}  // namespace

PsychometricSearch::PsychometricSearch(const PsychometricLevels& levels,
                                       PsychometricMethod method, bool free_pse,
                                       bool free_lapse)
    : method_(method),
      free_pse_(free_pse),
      free_lapse_(free_lapse),
      free_{true, free_pse, free_lapse, levels.ends.free_guess} {
  if (method == kMaximumLikelihood && levels.ends.are_bare(free_lapse)) return;
  if (why_unidentified(levels, free_pse, free_lapse).empty()) grid_.emplace(levels, free_pse);
}

PsychometricOptimum PsychometricSearch::lowest_minimum(
    const PsychometricLevels& levels, PsychometricDescent descent,
    const std::vector<PsychometricCurve>& starts) const {
  struct Scout {
    PsychometricCurve start;
    PsychometricOptimum reached;
  };
  std::vector<Scout> scouts;
  for (const PsychometricCurve& start : starts) {
    scouts.push_back({start, minimised_by_newton(levels, method_, free_, start)});
  }
  std::stable_sort(scouts.begin(), scouts.end(), [](const Scout& one, const Scout& other) {
    return one.reached.cost.value < other.reached.cost.value;
  });
  PsychometricOptimum best;
  best.cost.value = std::numeric_limits<double>::infinity();
  if (scouts.empty()) return best;
  if (descent == minimised_by_newton) return scouts.front().reached;

  const double lowest = scouts.front().reached.cost.value;
  const auto consider = [&](const PsychometricCurve& start) {
    const PsychometricOptimum found = descent(levels, method_, free_, start);
    // Among descents that end equally low, one that converged is preferred.
    const double lead = best.cost.value - found.cost.value;
    const double equal = rounding(found.cost.value);
    if (lead > equal || (lead >= -equal && found.converged && !best.converged)) best = found;
  };
  constexpr std::size_t kMostDescents = 3;
  for (std::size_t place = 0; place < std::min(scouts.size(), kMostDescents); ++place) {
    consider(scouts[place].start);
  }
  if (!best.converged || best.cost.value > lowest + rounding(lowest)) {
    consider(scouts.front().reached.curve);
  }
  return best;
}

PsychometricSearchResult PsychometricSearch::find(const PsychometricLevels& levels,
                                                  PsychometricDescent descent,
                                                  const PsychometricCurve* near) const {
  return found(levels, descent, near, [&] {
    std::vector<PsychometricCurve> starts = grid_->minima(levels, method_, free_lapse_);
    if (near != nullptr) starts.insert(starts.begin(), *near);
    return starts;
  });
}

PsychometricSearchResult PsychometricSearch::find_from(
    const PsychometricLevels& levels, const std::vector<PsychometricCurve>& starts) const {
  return found(levels, minimised_by_newton, starts.data(), [&] { return starts; });
}

PsychometricSearchResult PsychometricSearch::found(
    const PsychometricLevels& levels, PsychometricDescent descent,
    const PsychometricCurve* near,
    const std::function<std::vector<PsychometricCurve>()>& starts) const {
  const std::string_view why = why_unidentified(levels, free_pse_, free_lapse_);
  if (!why.empty()) return {PsychometricSupremum::kUnidentified, why, {}};
  if (method_ == kMaximumLikelihood && levels.zero_yes > 0.0 &&
      !levels.ends.low_is_possible(free_lapse_)) {
    return {PsychometricSupremum::kImpossible, kYesAtZero, {}};
  }
  PsychometricOptimum found;
  if (!grid_) {
    const PsychometricExistence existence = existence_from_counts(levels, free_pse_);
    if (existence.supremum != PsychometricSupremum::kAttained) {
      return {existence.supremum, existence.reason, {}};
    }
    found = descent(levels, method_, free_, near ? *near : concave_start(levels, free_pse_));
  } else {
    found = lowest_minimum(levels, descent, starts());
    const double step = step_limit_cost(levels, method_, free_pse_, free_lapse_);
    const double flat = flat_limit_cost(levels, method_, free_pse_, free_lapse_);
    const double limit_cost = std::min(step, flat);
    if (!(found.cost.value < limit_cost - rounding(limit_cost))) {
      const PsychometricExistence limit = lower_limit(levels, free_pse_, step, flat);
      return {limit.supremum, limit.reason, {}};
    }
    if (found.converged && is_ridge(found, free_)) {
      return {PsychometricSupremum::kUnidentified, kRidge, {}};
    }
  }
  return {
      found.converged ? PsychometricSupremum::kAttained : PsychometricSupremum::kNotConverged,
      "", found};
}

}  // namespace jnd::analysis
