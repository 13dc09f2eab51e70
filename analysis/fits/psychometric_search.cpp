#include "analysis/fits/psychometric_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/fits/normal_tail.h"
#include "analysis/fits/psychometric_limits.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr auto kMaximumLikelihood = PsychometricMethod::kMaximumLikelihood;

constexpr std::string_view kNoTrials = "no trials: there is no level with an answer";
constexpr std::string_view kAllAtReference =
    "all at the reference: no level differs from it, so nothing tells how fine the "
    "discrimination is";
constexpr std::string_view kOneIntensity =
    "one intensity: a slope and a pse need answers at two intensities or more";
constexpr std::string_view kTooFewForLapse =
    "too few levels: slope, pse and lapse rate cannot be told apart";
constexpr std::string_view kYesAtZero =
    "impossible: a yes at intensity 0 has probability 0 without lapses";
constexpr std::string_view kAllAlike =
    "all alike: every answer is the same, so the pse lies beyond all levels";
constexpr std::string_view kSeparated =
    "separated: one threshold splits the answers without overlap, so the Weber fraction falls "
    "to 0";
constexpr std::string_view kStep =
    "separated: a step explains the answers at least as well as any slope, so the Weber "
    "fraction falls to 0";
constexpr std::string_view kFlat =
    "flat: the answers do not rise with the intensity, so the Weber fraction grows without "
    "bound";
constexpr std::string_view kInverted =
    "inverted: yes becomes rarer as the intensity rises, so no Weber fraction > 0 fits";
constexpr std::string_view kRidge = "not identified: many curves fit equally well";

PsychometricSearchResult none(PsychometricSupremum supremum, std::string_view reason) {
  return {supremum, reason, {}};
}

/// Rise of the proportions along the levels, <= 0 if there is none; in trials for likelihood.
double rise(const PsychometricLevels& levels, bool free_pse) noexcept {
  double yes = 0.0, trials = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    yes += levels.num_yes[level];
    trials += levels.num_trials[level];
  }
  const double expected = free_pse ? yes / trials : 0.5;
  double sum = 0.0, size = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.log_ratio[level];
    sum += (levels.num_yes[level] - expected * levels.num_trials[level]) * u;
    size += levels.num_trials[level] * std::fabs(u);
  }
  return std::fabs(sum) <= 1e-14 * size ? 0.0 : sum;
}

std::string_view flat_or_inverted(const PsychometricLevels& levels, bool free_pse) noexcept {
  return rise(levels, free_pse) < 0.0 ? kInverted : kFlat;
}

/// Newton's first step from slope 0: close to the optimum unless the answers are nearly
/// separated.
PsychometricCurve concave_start(const PsychometricLevels& levels, bool free_pse) noexcept {
  double yes = 0.0, trials = 0.0, moment = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    yes += levels.num_yes[level];
    trials += levels.num_trials[level];
    moment += levels.num_trials[level] * levels.log_ratio[level];
  }
  const double mean = free_pse ? moment / trials : 0.0;
  double squares = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double distance = levels.log_ratio[level] - mean;
    squares += levels.num_trials[level] * distance * distance;
  }
  const double z = free_pse ? core::standard_normal_quantile(yes / trials) : 0.0;
  const double slope = rise(levels, free_pse) / (normal_tails(z).density * squares);
  return {slope, z - slope * mean, 0.0};
}

/// Whether the optimum of the concave likelihood exists, from the counts alone.
PsychometricSearchResult concave_existence(const PsychometricLevels& levels, bool free_pse) {
  // Smallest and largest log ratio with a yes, and with a no.
  double first_yes = kInfinity, last_yes = -kInfinity, first_no = kInfinity,
         last_no = -kInfinity;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.log_ratio[level];
    if (levels.num_yes[level] > 0.0) {
      first_yes = std::min(first_yes, u);
      last_yes = std::max(last_yes, u);
    }
    if (levels.num_yes[level] < levels.num_trials[level]) {
      first_no = std::min(first_no, u);
      last_no = std::max(last_no, u);
    }
  }
  if (free_pse) {
    if (last_yes == -kInfinity || last_no == -kInfinity) {
      return none(PsychometricSupremum::kStep, kAllAlike);
    }
    if (last_no <= first_yes) return none(PsychometricSupremum::kStep, kSeparated);
  } else if (!(first_yes < 0.0) && !(last_no > 0.0)) {
    return none(PsychometricSupremum::kStep, kSeparated);
  }
  if (!(rise(levels, free_pse) > 0.0)) {
    return none(PsychometricSupremum::kFlat, flat_or_inverted(levels, free_pse));
  }
  return none(PsychometricSupremum::kAttained, "");
}

/// Why the levels alone cannot identify the free parameters; "" if they can.
std::string_view unidentified(const PsychometricLevels& levels, bool free_pse,
                              bool free_lapse) {
  const int at_zero = levels.zero_trials > 0.0 ? 1 : 0;
  if (levels.size() == 0 && at_zero == 0) return kNoTrials;
  if (free_pse) {
    if (levels.size() < 2) return kOneIntensity;
    const int num_levels = static_cast<int>(levels.size()) + at_zero;
    return free_lapse && num_levels < 3 ? kTooFewForLapse : std::string_view();
  }
  std::vector<double> distances;  // A curve through the reference is symmetric about it.
  for (const double u : levels.log_ratio) {
    if (u != 0.0) distances.push_back(std::fabs(u));
  }
  std::sort(distances.begin(), distances.end());
  const auto last = std::unique(distances.begin(), distances.end(),
                                [](double a, double b) { return b - a <= 1e-12 * b; });
  const int num_distances = static_cast<int>(last - distances.begin());
  if (num_distances == 0) return kAllAtReference;
  return free_lapse && num_distances + at_zero < 2 ? kTooFewForLapse : std::string_view();
}

/// Whether the Hessian tells the moving parameters apart: by its scaled smallest eigenvalue.
bool is_ridge(const PsychometricOptimum& optimum, const FreeParameters& free) {
  FreeParameters moving = free;
  if (optimum.curve.lapse <= 0.0) moving[2] = false;
  Eigen::Matrix3d scaled = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d& hessian = optimum.cost.hessian;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      if (row == column || !moving[static_cast<std::size_t>(row)] ||
          !moving[static_cast<std::size_t>(column)]) {
        continue;
      }
      scaled(row, column) =
          hessian(row, column) / std::sqrt(hessian(row, row) * hessian(column, column));
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scaled, Eigen::EigenvaluesOnly);
  return !(eigen.eigenvalues()(0) > 1e-12);
}

/// Where to try the pse at one slope, ascending: every 0.7 z within 6 z of a level, and in the
/// middle of wider gaps.
std::vector<double> places_of_pse(const PsychometricLevels& levels, double slope) {
  constexpr double kReachZ = 6.0, kSpacingZ = 0.7, kMostPlaces = 400.0;
  const double reach = kReachZ / slope;
  const double range = levels.log_ratio.back() - levels.log_ratio.front();
  const double spacing = std::max(kSpacingZ / slope, range / kMostPlaces);
  std::vector<double> places;
  double next = levels.log_ratio.front() - reach;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double here = levels.log_ratio[level];
    if (here - reach > next) {
      places.push_back(0.5 * (levels.log_ratio[level - 1] + here));
      next = here - reach;
    }
    for (; next <= here + reach; next += spacing) places.push_back(next);
  }
  return places;
}

}  // namespace

PsychometricSearch::PsychometricSearch(const PsychometricLevels& levels,
                                       PsychometricMethod method, bool free_pse,
                                       bool free_lapse)
    : method_(method),
      free_pse_(free_pse),
      free_lapse_(free_lapse),
      free_{true, free_pse, free_lapse} {
  if (method == kMaximumLikelihood && !free_lapse) return;
  if (unidentified(levels, free_pse, free_lapse).empty()) build_grid(levels);
}

void PsychometricSearch::build_grid(const PsychometricLevels& levels) {
  // From nearly flat to a step between neighbours; a search may leave this range.
  constexpr double kFlattest = 0.02, kRatio = 1.2, kSteepestZ = 9.0, kSmallestGap = 1e-3;
  const double steepest = kSteepestZ / std::max(levels.smallest_gap(free_pse_), kSmallestGap);
  for (double slope = kFlattest; slope < steepest * kRatio; slope *= kRatio) {
    slope_begin_.push_back(grid_.size());
    const std::vector<double> places =
        free_pse_ ? places_of_pse(levels, slope) : std::vector<double>{0.0};
    for (const double place : places) grid_.push_back({slope, place});
  }
  slope_begin_.push_back(grid_.size());
  lower_tail_.reserve(grid_.size() * levels.size());
  for (const GridPoint& point : grid_) {
    for (const double u : levels.log_ratio) {
      lower_tail_.push_back(normal_tails(point.slope * (u - point.place)).lower);
    }
  }
}

bool PsychometricSearch::is_lowest_around(std::size_t slope, std::size_t point,
                                          const std::vector<double>& cost) const {
  // Strict on one side, so that a plateau counts once.
  const double here = cost[point];
  if (point > slope_begin_[slope] && cost[point - 1] <= here) return false;
  if (point + 1 < slope_begin_[slope + 1] && cost[point + 1] < here) return false;
  for (const bool steeper : {false, true}) {
    if (steeper ? slope + 2 >= slope_begin_.size() : slope == 0) continue;
    const std::size_t other = steeper ? slope + 1 : slope - 1;
    const auto begin = grid_.begin() + static_cast<std::ptrdiff_t>(slope_begin_[other]);
    const auto end = grid_.begin() + static_cast<std::ptrdiff_t>(slope_begin_[other + 1]);
    auto nearest =
        std::lower_bound(begin, end, grid_[point].place,
                         [](const GridPoint& one, double place) { return one.place < place; });
    if (nearest == end) --nearest;
    const double there = cost[static_cast<std::size_t>(nearest - grid_.begin())];
    if (steeper ? there < here : there <= here) return false;
  }
  return true;
}

std::vector<PsychometricCurve> PsychometricSearch::starts(
    const PsychometricLevels& levels) const {
  std::vector<double> cost, lapse;
  cost.reserve(grid_.size());
  lapse.reserve(grid_.size());
  for (std::size_t point = 0; point < grid_.size(); ++point) {
    const BestLapse best =
        best_lapse(levels, method_, free_lapse_, &lower_tail_[point * levels.size()]);
    cost.push_back(best.cost);
    lapse.push_back(std::min(best.lapse, 0.49));
  }
  std::vector<std::pair<double, std::size_t>> minima;
  for (std::size_t slope = 0; slope + 1 < slope_begin_.size(); ++slope) {
    for (std::size_t point = slope_begin_[slope]; point < slope_begin_[slope + 1]; ++point) {
      if (is_lowest_around(slope, point, cost)) minima.emplace_back(cost[point], point);
    }
  }
  constexpr std::size_t kMostStarts = 12;
  std::sort(minima.begin(), minima.end());
  if (minima.size() > kMostStarts) minima.resize(kMostStarts);
  std::vector<PsychometricCurve> curves;
  for (const auto& [value, point] : minima) {
    const GridPoint& at = grid_[point];
    curves.push_back({at.slope, -at.slope * at.place, lapse[point]});
  }
  return curves;
}

PsychometricSearchResult PsychometricSearch::grid_optimum(const PsychometricLevels& levels,
                                                          const PsychometricCurve* near) const {
  PsychometricOptimum best;
  best.cost.value = kInfinity;
  const auto consider = [&](const PsychometricCurve& start) {
    const PsychometricOptimum found = minimised(levels, method_, free_, start);
    if (found.cost.value < best.cost.value) best = found;
  };
  if (near != nullptr) consider(*near);
  for (const PsychometricCurve& start : starts(levels)) consider(start);

  const double step = step_limit_cost(levels, method_, free_pse_, free_lapse_);
  const double flat = flat_limit_cost(levels, method_, free_pse_, free_lapse_);
  const double limit = std::min(step, flat);
  if (!(best.cost.value < limit - 1e-13 * limit - 1e-26)) {
    return step < flat ? none(PsychometricSupremum::kStep, kStep)
                       : none(PsychometricSupremum::kFlat, flat_or_inverted(levels, free_pse_));
  }
  if (!best.converged) return {PsychometricSupremum::kNotConverged, "", best};
  if (is_ridge(best, free_)) return none(PsychometricSupremum::kUnidentified, kRidge);
  return {PsychometricSupremum::kAttained, "", best};
}

PsychometricSearchResult PsychometricSearch::find(const PsychometricLevels& levels,
                                                  const PsychometricCurve* near) const {
  const std::string_view why = unidentified(levels, free_pse_, free_lapse_);
  if (!why.empty()) return none(PsychometricSupremum::kUnidentified, why);
  if (method_ != kMaximumLikelihood || free_lapse_) return grid_optimum(levels, near);
  if (levels.zero_yes > 0.0) return none(PsychometricSupremum::kImpossible, kYesAtZero);
  PsychometricSearchResult result = concave_existence(levels, free_pse_);
  if (result.supremum != PsychometricSupremum::kAttained) return result;
  result.optimum =
      minimised(levels, method_, free_, near ? *near : concave_start(levels, free_pse_));
  if (!result.optimum.converged) result.supremum = PsychometricSupremum::kNotConverged;
  return result;
}

}  // namespace jnd::analysis
