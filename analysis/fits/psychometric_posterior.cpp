#include "analysis/fits/psychometric_posterior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "analysis/fits/posterior_axis.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using core::kInfinity;
constexpr double kTail = 0.025;  ///< The probability on either side of an interval.

using Axis = PosteriorAxis;
using Axes = PosteriorGrid::Axes;
using Marginals = std::array<std::vector<double>, 4>;
constexpr std::size_t kNumAxes = 4;

/// The ranges where the priors are not 0.
Axes prior_axes(const PsychometricLevels& levels, const FreeParameters& free) {
  const double range =
      free[1] ? levels.abscissa.back() - levels.abscissa.front()
              : std::max(std::fabs(levels.abscissa.front()), std::fabs(levels.abscissa.back()));
  const double gap = levels.smallest_gap(free[1]);
  Axes axes;
  // If both rates are free, each parameter gets fewer values.
  const bool both = free[2] && free[3];
  axes[0] = {std::log(gap / 4.0), std::log(4.0 * range),
             both                 ? 51U
             : free[2] || free[3] ? 101U
                                  : 201U};
  if (free[1]) {
    axes[1] = {levels.abscissa.front() - 0.5 * range, levels.abscissa.back() + 0.5 * range,
               both ? 51U : 121U};
  }
  const std::size_t num_rates = both ? 17 : 31;
  axes[2] = {levels.ends.known_lapse, levels.ends.known_lapse, 1};
  if (free[2]) axes[2] = {0.0, std::min(0.5, levels.ends.lapse_limit()) - 1e-9, num_rates};
  axes[3] = {0.0, 0.0, 1};
  if (free[3]) axes[3] = {0.0, levels.ends.largest_guess(), num_rates};
  return axes;
}

double log_likelihood_of(const PsychometricLevels& levels, const std::vector<double>& tail,
                         const std::vector<double>& upper, double lapse, double guess) {
  const auto term = [](double count, double probability) {
    return count > 0.0 ? count * std::log(probability) : 0.0;
  };
  const double low = levels.ends.low(lapse, guess), rise = levels.ends.rise(lapse, guess);
  double sum = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    sum += term(levels.num_yes[level], low + rise * tail[level]);
    sum += term(levels.num_trials[level] - levels.num_yes[level], lapse + rise * upper[level]);
  }
  return sum + term(levels.zero_yes, low) +
         term(levels.zero_trials - levels.zero_yes, 1.0 - low);
}

/// The logarithm of a rate's prior density, up to a constant. It is the same at every point of
/// the grid if the rate is known.
double log_prior_of(const Axis& axis, double rate, const BetaPrior& prior) {
  const double attentive = (prior.b - 1.0) * std::log1p(-rate);
  const bool has_more = axis.size > 1 && prior.a > 1.0;
  return has_more ? attentive + (prior.a - 1.0) * std::log(rate) : attentive;
}

/// The posterior over the grid, up to a factor, in the order slope, place, lapse, guess. The
/// last one varies fastest.
std::vector<double> density_over(const PsychometricLevels& levels, const Axes& axes,
                                 const BetaPrior& rates) {
  std::vector<double> density;
  density.reserve(axes[0].size * axes[1].size * axes[2].size * axes[3].size);
  std::vector<double> lower(levels.size()), upper(levels.size());
  double largest = -kInfinity;
  for (std::size_t i = 0; i < axes[0].size; ++i) {
    const double slope = std::exp(-axes[0].at(i));
    for (std::size_t j = 0; j < axes[1].size; ++j) {
      for (std::size_t level = 0; level < levels.size(); ++level) {
        const SigmoidTails tails =
            sigmoid_tails(levels.sigmoid, slope * (levels.abscissa[level] - axes[1].at(j)));
        lower[level] = tails.lower;
        upper[level] = tails.upper;
      }
      for (std::size_t k = 0; k < axes[2].size; ++k) {
        const double lapse = axes[2].at(k);
        for (std::size_t l = 0; l < axes[3].size; ++l) {
          const double guess = axes[3].at(l);
          density.push_back(log_likelihood_of(levels, lower, upper, lapse, guess) +
                            log_prior_of(axes[2], lapse, rates) +
                            log_prior_of(axes[3], guess, rates));
          largest = std::max(largest, density.back());
        }
      }
    }
  }
  for (double& value : density) value = std::exp(value - largest);
  return density;
}

/// Calls `visit(at, density)` for every point of the grid. `at` holds the point's indices on
/// the axes.
template <typename Visit>
void over_grid(const Axes& axes, const std::vector<double>& density, const Visit& visit) {
  std::size_t place = 0;
  for (std::size_t i = 0; i < axes[0].size; ++i) {
    for (std::size_t j = 0; j < axes[1].size; ++j) {
      for (std::size_t k = 0; k < axes[2].size; ++k) {
        for (std::size_t l = 0; l < axes[3].size; ++l) {
          visit(std::array{i, j, k, l}, density[place++]);
        }
      }
    }
  }
}

/// The weight of a point of the grid over all axes except those that are named.
double weight_but(const Axes& axes, const std::array<std::size_t, kNumAxes>& at,
                  std::size_t but, std::size_t but_too = kNumAxes) {
  double weight = 1.0;
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    if (axis != but && axis != but_too) weight *= axes[axis].weight(at[axis]);
  }
  return weight;
}

/// The marginal of each parameter: the posterior integrated over all others.
Marginals marginals_of(const Axes& axes, const std::vector<double>& density) {
  Marginals marginals;
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    marginals[axis].assign(axes[axis].size, 0.0);
  }
  over_grid(axes, density, [&](const auto& at, double value) {
    for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
      marginals[axis][at[axis]] += value * weight_but(axes, at, axis);
    }
  });
  return marginals;
}

/// The distribution of the Weber fraction over the intensity itself, w = spread / pse. It is
/// the distribution of ln spread, shifted by ln pse, over all places. A pse that is not > 0
/// counts as an infinite w.
class LinearFraction {
 public:
  LinearFraction(const PsychometricLevels& levels, const Axes& axes,
                 const std::vector<double>& density)
      : axis_(axes[0]) {
    std::vector<double> joint(axes[0].size * axes[1].size, 0.0);
    over_grid(axes, density, [&](const auto& at, double value) {
      joint[at[0] * axes[1].size + at[1]] += value * weight_but(axes, at, 0, 1);
    });
    for (std::size_t j = 0; j < axes[1].size; ++j) {
      Column column;
      for (std::size_t i = 0; i < axis_.size; ++i) {
        column.density.push_back(joint[i * axes[1].size + j]);
      }
      column.sum = cumulated(axis_, column.density);
      column.weight = axes[1].weight(j);
      all_ += column.weight * column.sum.back();
      const double pse = levels.intensity_at(axes[1].at(j));
      if (!(pse > 0.0)) continue;
      column.shift = std::log(pse / (sigmoid_jnd(levels.sigmoid) * levels.unit));
      columns_.push_back(std::move(column));
    }
  }

  [[nodiscard]] std::optional<double> quantile(double probability) const {
    double low = kInfinity, high = -kInfinity;
    for (const Column& column : columns_) {
      low = std::min(low, axis_.low - column.shift);
      high = std::max(high, axis_.high - column.shift);
    }
    if (!(low < high) || share_below(high) < probability) return std::nullopt;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (low + high);
      (share_below(middle) < probability ? low : high) = middle;
    }
    return std::exp(0.5 * (low + high));
  }

 private:
  struct Column {
    std::vector<double> density, sum;
    double weight = 0.0, shift = 0.0;
  };
  [[nodiscard]] double share_below(double log_fraction) const {
    double sum = 0.0;
    for (const Column& column : columns_) {
      sum += column.weight *
             cumulated_at(axis_, column.density, column.sum, log_fraction + column.shift);
    }
    return sum / all_;
  }

  Axis axis_;
  std::vector<Column> columns_;
  double all_ = 0.0;
};

std::string words_of_priors(const PsychometricLevels& levels, const FreeParameters& free,
                            const BetaPrior& rates) {
  char beta[64];
  std::snprintf(beta, sizeof beta, "Beta(%g, %g)", rates.a, rates.b);
  const std::string of = levels.logarithmic() ? "logarithms of the levels" : "levels";
  std::string words = "ln spread of the curve uniform from a quarter of the smallest step " +
                      std::string(free[1] ? "between" : "from the reference among") + " the " +
                      of + " to four times their range";
  if (free[1]) words += "; pse uniform within their range and half of it to either side";
  if (free[2]) {
    const bool halved = levels.ends.lapse_limit() < 0.5;
    words += "; lapse rate " + std::string(beta) + " below " +
             std::string(halved ? "where the curve no longer rises" : "0.5");
  }
  if (free[3]) words += "; guess rate " + std::string(beta) + " below 0.5";
  return words;
}

/// The mass that a wider prior would add below and above the medians, divided by the present
/// mass.
struct MassBeyond {
  double fraction_low = 0.0, fraction_high = 0.0, pse_low = 0.0, pse_high = 0.0;
};

/// For each end of each prior it estimates the mass that would lie beyond it, up to the
/// distance from the median to the end of the interval. It also finds on which side of each
/// median that mass would lie. A lapse rate of 0, or one that leaves no curve, is a natural end
/// and not one of the prior.
MassBeyond beyond_the_prior(const PsychometricLevels& levels, const Axes& prior,
                            const Axes& axes, const std::vector<double>& density,
                            const Marginals& marginals,
                            const PsychometricPosterior& posterior) {
  MassBeyond all;
  for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
    if (axes[axis].size == 1) continue;
    for (const bool at_high : {false, true}) {
      if (axis == 2 && (!at_high || prior[2].high > levels.ends.lapse_limit() - 1e-6)) continue;
      if (axis == 3 && !at_high) continue;
      const double near = 0.5 * axes[axis].step();
      const bool reaches = at_high ? axes[axis].high > prior[axis].high - near
                                   : axes[axis].low < prior[axis].low + near;
      if (!reaches) continue;
      const double median = quantile_of(axes[axis], marginals[axis], 0.5);
      const double end =
          quantile_of(axes[axis], marginals[axis], at_high ? 1.0 - kTail : kTail);
      const double mass =
          mass_beyond(axes[axis], marginals[axis], at_high, std::fabs(median - end));
      const std::size_t at = at_high ? axes[axis].size - 1 : 0;
      double sum = 0.0, fraction_below = 0.0, pse_below = 0.0;
      over_grid(axes, density, [&](const auto& places, double value) {
        if (places[axis] != at) return;
        const double weight = value * weight_but(axes, places, axis);
        const double pse = levels.intensity_at(axes[1].at(places[1]));
        const double fraction = levels.weber_fraction_at(std::exp(-axes[0].at(places[0])), pse);
        sum += weight;
        if (fraction < posterior.weber_fraction.value_or(kInfinity)) fraction_below += weight;
        if (pse < posterior.pse.value_or(0.0)) pse_below += weight;
      });
      if (!(sum > 0.0)) continue;
      all.fraction_low += mass * fraction_below / sum;
      all.fraction_high += mass * (1.0 - fraction_below / sum);
      all.pse_low += mass * pse_below / sum;
      all.pse_high += mass * (1.0 - pse_below / sum);
    }
  }
  return all;
}

/// Opens the ends that the prior has caused: those beyond which more mass would lie than in the
/// interval's own tail.
void open_ends(PsychometricPosterior& posterior, const MassBeyond& beyond) {
  const auto opened = [](Interval& ends, double low, double high) {
    if (low > kTail) ends.low.reset();
    if (high > kTail) ends.high.reset();
    return low > kTail || high > kTail;
  };
  const bool fraction =
      opened(posterior.weber_fraction_ci95, beyond.fraction_low, beyond.fraction_high);
  const bool pse =
      posterior.pse_ci95 && opened(*posterior.pse_ci95, beyond.pse_low, beyond.pse_high);
  if (!fraction && !pse) return;
  const std::string what = fraction && pse ? "the Weber fraction and the pse"
                           : fraction      ? "the Weber fraction"
                                           : "the pse";
  posterior.note = "the answers do not bound " + what +
                   " within the prior: value and interval rest on it, and the end concerned is "
                   "open";
}

}  // namespace

PosteriorGrid posterior_grid(const PsychometricLevels& levels, const FreeParameters& free,
                             const BetaPrior& rates) {
  PosteriorGrid grid;
  grid.reason = why_unidentified(levels, free[1], free[2]);
  if (grid.reason.empty() && levels.zero_yes > 0.0 && !levels.ends.low_is_possible(free[2])) {
    grid.reason = kYesAtZero;
  }
  if (!grid.reason.empty()) return grid;
  grid.priors = words_of_priors(levels, free, rates);
  grid.prior = prior_axes(levels, free);
  grid.axes = grid.prior;
  grid.density = density_over(levels, grid.axes, rates);
  grid.marginals = marginals_of(grid.axes, grid.density);
  for (int narrowing = 0; narrowing < 3; ++narrowing) {
    for (std::size_t axis = 0; axis < kNumAxes; ++axis) {
      grid.axes[axis] = narrowed(grid.axes[axis], grid.marginals[axis]);
    }
    grid.density = density_over(levels, grid.axes, rates);
    grid.marginals = marginals_of(grid.axes, grid.density);
  }
  return grid;
}

std::array<double, 3> PosteriorGrid::quantiles(
    const std::function<double(const PsychometricCurve&)>& value_of) const {
  struct Point {
    double value, mass;
  };
  std::vector<Point> points;
  points.reserve(density.size());
  double all = 0.0;
  over_grid(axes, density, [&](const auto& at, double dense) {
    const double mass = dense * weight_but(axes, at, kNumAxes);
    if (!(mass > 0.0)) return;
    const double slope = std::exp(-axes[0].at(at[0]));
    const double value =
        value_of({slope, -slope * axes[1].at(at[1]), axes[2].at(at[2]), axes[3].at(at[3])});
    if (std::isnan(value)) return;
    points.push_back({value, mass});
    all += mass;
  });
  std::ranges::sort(points, {}, &Point::value);
  // Half of a point's mass lies below it.
  const auto at = [&](double probability) {
    double below = 0.0, last = points.front().value, reached = 0.0;
    for (const Point& point : points) {
      const double here = (below + 0.5 * point.mass) / all;
      if (here >= probability) {
        const double share = here > reached ? (probability - reached) / (here - reached) : 1.0;
        return std::isfinite(last) && std::isfinite(point.value)
                   ? last + share * (point.value - last)
                   : point.value;
      }
      below += point.mass;
      last = point.value;
      reached = here;
    }
    return points.back().value;
  };
  if (points.empty()) return {std::nan(""), std::nan(""), std::nan("")};
  return {at(0.5), at(kTail), at(1.0 - kTail)};
}

PsychometricPosterior posterior_on_grid(const PsychometricLevels& levels,
                                        const FreeParameters& free, const BetaPrior& rates) {
  PsychometricPosterior posterior;
  posterior.status = FitStatus::kDegenerate;
  const PosteriorGrid grid = posterior_grid(levels, free, rates);
  posterior.reason = grid.reason;
  if (!posterior.reason.empty()) return posterior;
  const Axes& axes = grid.axes;
  const std::vector<double>& density = grid.density;
  const auto quantile = [&](std::size_t axis, double probability) {
    return quantile_of(axes[axis], grid.marginals[axis], probability);
  };
  posterior.status = FitStatus::kOk;
  posterior.priors = grid.priors;
  if (levels.logarithmic()) {
    const auto fraction = [&](double probability) {
      return levels.weber_fraction_at(std::exp(-quantile(0, probability)), levels.origin);
    };
    posterior.weber_fraction = fraction(0.5);
    posterior.weber_fraction_ci95 = {fraction(0.025), fraction(0.975)};
  } else {
    const LinearFraction fraction(levels, axes, density);
    posterior.weber_fraction = fraction.quantile(0.5);
    posterior.weber_fraction_ci95 = {fraction.quantile(0.025), fraction.quantile(0.975)};
  }
  if (free[1]) {
    posterior.pse = levels.intensity_at(quantile(1, 0.5));
    posterior.pse_ci95 = Interval{levels.intensity_at(quantile(1, 0.025)),
                                  levels.intensity_at(quantile(1, 0.975))};
  }
  if (free[2]) posterior.lapse_rate = quantile(2, 0.5);
  open_ends(posterior,
            beyond_the_prior(levels, grid.prior, axes, density, grid.marginals, posterior));
  return posterior;
}

std::vector<PosteriorPriorEffect> posterior_prior_effects(const PsychometricLevels& levels,
                                                          const FreeParameters& free,
                                                          const BetaPrior& rates) {
  std::vector<PosteriorPriorEffect> effects;
  for (const double weight : kOtherPriorWeights) {
    const BetaPrior prior = rates.weighed(weight);
    const PsychometricPosterior other = posterior_on_grid(levels, free, prior);
    if (other.status != FitStatus::kOk) continue;
    effects.push_back({weight, prior, other.weber_fraction, other.pse, other.lapse_rate});
  }
  return effects;
}

}  // namespace jnd::analysis
