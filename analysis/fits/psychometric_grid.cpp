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

/// The ascending places at which the pse is tried for one slope. They are `spacing_z` apart
/// within 6 z of a level, with one more in the middle of each wider gap.
std::vector<double> places_of_pse(const PsychometricLevels& levels, double slope,
                                  double spacing_z) {
  constexpr double kReachZ = 6.0, kMostPlaces = 400.0;
  const double reach = kReachZ / slope;
  const double range = levels.abscissa.back() - levels.abscissa.front();
  const double spacing = std::max(spacing_z / slope, range / kMostPlaces);
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

/// This many levels are enough to tell where the minima are. The search continues from there
/// with all levels.
constexpr std::size_t kMostLevels = 512;

/// The index at which each of at most `kMostLevels` groups of neighbouring levels begins, and
/// at last the number of levels.
std::vector<std::size_t> groups_of(std::size_t num_levels) {
  const std::size_t num = std::min(num_levels, kMostLevels);
  std::vector<std::size_t> begin;
  for (std::size_t i = 0; i <= num; ++i) begin.push_back(i * num_levels / num);
  return begin;
}

/// Levels in which each group is pooled into one level, at the mean of its places on the
/// abscissa.
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

PsychometricGrid::PsychometricGrid(const PsychometricLevels& every_level, bool free_pse,
                                   const GridSpacing& spacing) {
  const PsychometricLevels levels = grouped(every_level);
  // A descent from the grid may leave this range.
  constexpr double kSmallestGap = 1e-3;
  const double steepest_z = 2.25 * sigmoid_reach(levels.sigmoid);
  const double steepest = steepest_z / std::max(levels.smallest_gap(free_pse), kSmallestGap);
  for (double slope = spacing.flattest; slope < steepest * spacing.ratio;
       slope *= spacing.ratio) {
    slope_begin_.push_back(points_.size());
    if (!free_pse) {
      add(levels, free_pse, slope, 0.0);
      continue;
    }
    for (const double place : places_of_pse(levels, slope, spacing.place_z)) {
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
    // A level at a fixed pse has F = 0.5 for every slope.
    if ((free_pse || u != 0.0) && std::fabs(z) < sigmoid_reach(levels.sigmoid)) ++num_rising;
  }
  points_.push_back({slope, place, num_rising < (free_pse ? 2 : 1)});
}

bool PsychometricGrid::is_lowest_around(std::size_t slope, std::size_t point,
                                        const std::vector<double>& cost) const {
  // The comparison is strict on one side only, so a plateau counts once.
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
    // The two points of the other slope whose places enclose the point's place.
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
  std::vector<double> cost, lapse, guess;
  cost.reserve(points_.size());
  lapse.reserve(points_.size());
  guess.reserve(points_.size());
  for (std::size_t point = 0; point < points_.size(); ++point) {
    const BestLapse best =
        best_lapse(levels, method, free_lapse, &lower_tail_[point * levels.size()]);
    cost.push_back(best.cost);
    lapse.push_back(free_lapse ? std::min(best.lapse, largest_lapse) : best.lapse);
    guess.push_back(best.guess);
  }
  constexpr std::size_t kMostMinima = 12;
  std::vector<PsychometricCurve> curves;
  for (const std::size_t point : lowest_points(cost, kMostMinima)) {
    const Point& at = points_[point];
    curves.push_back({at.slope, -at.slope * at.place, lapse[point], guess[point]});
  }
  return curves;
}

std::vector<std::size_t> PsychometricGrid::lowest_points(const std::vector<double>& cost,
                                                         std::size_t most) const {
  std::vector<std::pair<double, std::size_t>> lowest;
  for (std::size_t slope = 0; slope + 1 < slope_begin_.size(); ++slope) {
    for (std::size_t point = slope_begin_[slope]; point < slope_begin_[slope + 1]; ++point) {
      if (!points_[point].is_step && is_lowest_around(slope, point, cost)) {
        lowest.emplace_back(cost[point], point);
      }
    }
  }
  std::sort(lowest.begin(), lowest.end());
  if (lowest.size() > most) lowest.resize(most);
  std::vector<std::size_t> points;
  for (const auto& [value, point] : lowest) points.push_back(point);
  return points;
}

std::vector<double> PsychometricGrid::log_likelihoods(const PsychometricLevels& every_level,
                                                      double lapse, double guess) const {
  // The bound keeps the sum finite if a probability is 0 or 1 where the count is 0.
  constexpr double kLeast = -1e6;
  const PsychometricLevels levels = grouped(every_level);
  const double low = levels.ends.low(lapse, guess), rise = levels.ends.rise(lapse, guess);
  std::vector<double> logs;
  logs.reserve(2 * lower_tail_.size());
  for (const double lower : lower_tail_) {
    const double f = low + rise * lower;
    logs.push_back(std::max(kLeast, std::log(f)));
    logs.push_back(std::max(kLeast, std::log1p(-f)));
  }
  return logs;
}

std::vector<PsychometricCurve> PsychometricGrid::minima(const PsychometricLevels& every_level,
                                                        const std::vector<double>& logs,
                                                        double lapse, double guess,
                                                        std::size_t most) const {
  std::vector<double> counts;  // The yes and no of each level.
  const auto add = [&](const PsychometricLevels& levels) {
    for (std::size_t level = 0; level < levels.size(); ++level) {
      counts.push_back(levels.num_yes[level]);
      counts.push_back(levels.num_trials[level] - levels.num_yes[level]);
    }
  };
  if (every_level.size() > kMostLevels) {
    add(grouped(every_level));
  } else {
    add(every_level);
  }
  std::vector<double> cost(points_.size());
  for (std::size_t point = 0; point < points_.size(); ++point) {
    const double* const its = &logs[point * counts.size()];
    double sum = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) sum -= counts[i] * its[i];
    cost[point] = sum;
  }
  std::vector<PsychometricCurve> curves;
  for (const std::size_t point : lowest_points(cost, most)) {
    const Point& at = points_[point];
    curves.push_back({at.slope, -at.slope * at.place, lapse, guess});
  }
  return curves;
}

}  // namespace jnd::analysis
