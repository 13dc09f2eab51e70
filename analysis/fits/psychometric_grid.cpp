#include "analysis/fits/psychometric_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/fits/psychometric_limits.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using core::kInfinity;

/// Where to try the pse at one slope, ascending: every 0.7 z within 6 z of a level, and in the
/// middle of wider gaps.
std::vector<double> places_of_pse(const PsychometricLevels& levels, double slope) {
  constexpr double kReachZ = 6.0, kSpacingZ = 0.7, kMostPlaces = 400.0;
  const double reach = kReachZ / slope;
  const double range = levels.abscissa.back() - levels.abscissa.front();
  const double spacing = std::max(kSpacingZ / slope, range / kMostPlaces);
  std::vector<double> places;
  double next = levels.abscissa.front() - reach;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double here = levels.abscissa[level];
    if (here - reach > next) {
      places.push_back(0.5 * (levels.abscissa[level - 1] + here));
      next = here - reach;
    }
    for (; next <= here + reach; next += spacing) places.push_back(next);
  }
  return places;
}

/// So many levels tell where the minima are: the search goes on from there with all of them.
constexpr std::size_t kMostLevels = 512;

/// Where each of at most `kMostLevels` groups of neighbouring levels begins, then their end.
std::vector<std::size_t> groups_of(std::size_t num_levels) {
  const std::size_t num = std::min(num_levels, kMostLevels);
  std::vector<std::size_t> begin;
  for (std::size_t i = 0; i <= num; ++i) begin.push_back(i * num_levels / num);
  return begin;
}

/// Each group one level, at the mean of its places on the abscissa.
PsychometricLevels grouped(const PsychometricLevels& levels) {
  if (levels.size() <= kMostLevels) return levels;
  PsychometricLevels result = levels;
  for (auto* column :
       {&result.intensity, &result.abscissa, &result.num_yes, &result.num_trials}) {
    column->clear();
  }
  const std::vector<std::size_t> begin = groups_of(levels.size());
  for (std::size_t group = 0; group + 1 < begin.size(); ++group) {
    double place = 0.0, num_yes = 0.0, num_trials = 0.0;
    for (std::size_t level = begin[group]; level < begin[group + 1]; ++level) {
      place += levels.abscissa[level];
      num_yes += levels.num_yes[level];
      num_trials += levels.num_trials[level];
    }
    result.intensity.push_back(levels.intensity[begin[group]]);
    result.abscissa.push_back(place / static_cast<double>(begin[group + 1] - begin[group]));
    result.num_yes.push_back(num_yes);
    result.num_trials.push_back(num_trials);
  }
  return result;
}

}  // namespace

PsychometricGrid::PsychometricGrid(const PsychometricLevels& every_level, bool free_pse) {
  const PsychometricLevels levels = grouped(every_level);
  // A search may leave this range.
  constexpr double kFlattest = 0.002, kRatio = 1.2, kSmallestGap = 1e-3;
  const double steepest_z = 2.25 * sigmoid_reach(levels.sigmoid);
  const double steepest = steepest_z / std::max(levels.smallest_gap(free_pse), kSmallestGap);
  for (double slope = kFlattest; slope < steepest * kRatio; slope *= kRatio) {
    slope_begin_.push_back(points_.size());
    if (!free_pse) {
      add(levels, free_pse, slope, 0.0);
      continue;
    }
    for (const double place : places_of_pse(levels, slope)) {
      add(levels, free_pse, slope, place);
    }
  }
  slope_begin_.push_back(points_.size());
}

void PsychometricGrid::add(const PsychometricLevels& levels, bool free_pse, double slope,
                           double place) {
  int num_rising = 0;
  for (const double u : levels.abscissa) {
    const double z = slope * (u - place);
    lower_tail_.push_back(sigmoid_tails(levels.sigmoid, z).lower);
    // A level at a fixed pse is at F = 0.5 whatever the slope.
    if ((free_pse || u != 0.0) && std::fabs(z) < sigmoid_reach(levels.sigmoid)) ++num_rising;
  }
  points_.push_back({slope, place, num_rising < (free_pse ? 2 : 1)});
}

bool PsychometricGrid::is_lowest_around(std::size_t slope, std::size_t point,
                                        const std::vector<double>& cost) const {
  // Strict on one side, so that a plateau counts once.
  const double here = cost[point];
  if (point > slope_begin_[slope] && cost[point - 1] <= here) return false;
  if (point + 1 < slope_begin_[slope + 1] && cost[point + 1] < here) return false;
  for (const bool steeper : {false, true}) {
    if (steeper ? slope + 2 >= slope_begin_.size() : slope == 0) continue;
    const std::size_t other = steeper ? slope + 1 : slope - 1;
    const auto begin = points_.begin() + static_cast<std::ptrdiff_t>(slope_begin_[other]);
    const auto end = points_.begin() + static_cast<std::ptrdiff_t>(slope_begin_[other + 1]);
    const auto above =
        std::lower_bound(begin, end, points_[point].place,
                         [](const Point& one, double place) { return one.place < place; });
    // The places on either side of it.
    const auto first = static_cast<std::size_t>(above - points_.begin());
    double there = above == end ? kInfinity : cost[first];
    if (above != begin) there = std::min(there, cost[first - 1]);
    if (steeper ? there < here : there <= here) return false;
  }
  return true;
}

std::vector<PsychometricCurve> PsychometricGrid::minima(const PsychometricLevels& every_level,
                                                        PsychometricMethod method,
                                                        bool free_lapse) const {
  const PsychometricLevels levels = grouped(every_level);
  const double largest_lapse = 0.98 * levels.ends.lapse_limit();
  std::vector<double> cost, lapse;
  cost.reserve(points_.size());
  lapse.reserve(points_.size());
  for (std::size_t point = 0; point < points_.size(); ++point) {
    const BestLapse best =
        best_lapse(levels, method, free_lapse, &lower_tail_[point * levels.size()]);
    cost.push_back(best.cost);
    lapse.push_back(std::min(best.lapse, largest_lapse));
  }
  std::vector<std::pair<double, std::size_t>> lowest;
  for (std::size_t slope = 0; slope + 1 < slope_begin_.size(); ++slope) {
    for (std::size_t point = slope_begin_[slope]; point < slope_begin_[slope + 1]; ++point) {
      if (!points_[point].is_step && is_lowest_around(slope, point, cost)) {
        lowest.emplace_back(cost[point], point);
      }
    }
  }
  constexpr std::size_t kMostMinima = 12;
  std::sort(lowest.begin(), lowest.end());
  if (lowest.size() > kMostMinima) lowest.resize(kMostMinima);
  std::vector<PsychometricCurve> curves;
  for (const auto& [value, point] : lowest) {
    const Point& at = points_[point];
    curves.push_back({at.slope, -at.slope * at.place, lapse[point]});
  }
  return curves;
}

}  // namespace jnd::analysis
