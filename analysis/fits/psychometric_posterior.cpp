#include "analysis/fits/psychometric_posterior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace jnd::analysis {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLapsePriorPower = 9.0;  ///< Beta(1, 10): (1 - lapse)^9.

/// Evenly spaced values of one parameter, an odd number of them.
struct Axis {
  double low = 0.0, high = 0.0;
  std::size_t size = 1;

  [[nodiscard]] double step() const noexcept {
    return size > 1 ? (high - low) / static_cast<double>(size - 1) : 0.0;
  }
  [[nodiscard]] double at(std::size_t i) const noexcept {
    return low + step() * static_cast<double>(i);
  }
  /// Simpson's weight; 1 for a parameter that is held.
  [[nodiscard]] double weight(std::size_t i) const noexcept {
    if (size == 1) return 1.0;
    const double share = i == 0 || i + 1 == size ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    return share * step() / 3.0;
  }
};

using Axes = std::array<Axis, 3>;  ///< ln(1 / slope), place of the pse, lapse rate.
using Marginals = std::array<std::vector<double>, 3>;

/// Where the priors are not 0.
Axes prior_axes(const PsychometricLevels& levels, const FreeParameters& free) {
  const double range =
      free[1] ? levels.abscissa.back() - levels.abscissa.front()
              : std::max(std::fabs(levels.abscissa.front()), std::fabs(levels.abscissa.back()));
  const double gap = levels.smallest_gap(free[1]);
  Axes axes;
  axes[0] = {std::log(gap / 4.0), std::log(4.0 * range), free[2] ? 101U : 201U};
  if (free[1]) {
    axes[1] = {levels.abscissa.front() - 0.5 * range, levels.abscissa.back() + 0.5 * range,
               121};
  }
  if (free[2]) axes[2] = {0.0, 0.5 - 1e-9, 31};
  return axes;
}

double log_likelihood_of(const PsychometricLevels& levels, const std::vector<double>& tail,
                         const std::vector<double>& upper, double lapse) {
  const auto term = [](double count, double probability) {
    return count > 0.0 ? count * std::log(probability) : 0.0;
  };
  const double share = 1.0 - 2.0 * lapse;
  double sum = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    sum += term(levels.num_yes[level], lapse + share * tail[level]);
    sum += term(levels.num_trials[level] - levels.num_yes[level], lapse + share * upper[level]);
  }
  return sum + term(levels.zero_yes, lapse) +
         term(levels.zero_trials - levels.zero_yes, 1.0 - lapse);
}

/// Posterior over the grid, up to a factor, integrated over all but one parameter, for each.
/// `joint` is given that of the first two, the place within the slope.
Marginals marginals_over(const PsychometricLevels& levels, const Axes& axes,
                         std::vector<double>* joint = nullptr) {
  std::vector<double> log_density;
  log_density.reserve(axes[0].size * axes[1].size * axes[2].size);
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
        log_density.push_back(log_likelihood_of(levels, lower, upper, lapse) +
                              kLapsePriorPower * std::log1p(-lapse));
        largest = std::max(largest, log_density.back());
      }
    }
  }
  Marginals marginals;
  for (std::size_t axis = 0; axis < 3; ++axis) marginals[axis].assign(axes[axis].size, 0.0);
  if (joint != nullptr) joint->assign(axes[0].size * axes[1].size, 0.0);
  std::size_t place = 0;
  for (std::size_t i = 0; i < axes[0].size; ++i) {
    for (std::size_t j = 0; j < axes[1].size; ++j) {
      for (std::size_t k = 0; k < axes[2].size; ++k) {
        const double density = std::exp(log_density[place++] - largest);
        marginals[0][i] += density * axes[1].weight(j) * axes[2].weight(k);
        marginals[1][j] += density * axes[0].weight(i) * axes[2].weight(k);
        marginals[2][k] += density * axes[0].weight(i) * axes[1].weight(j);
        if (joint != nullptr) (*joint)[i * axes[1].size + j] += density * axes[2].weight(k);
      }
    }
  }
  return marginals;
}

/// The stretch of the axis where the density matters, one step wider.
Axis narrowed(const Axis& axis, const std::vector<double>& density) {
  constexpr double kNegligible = 1e-10;
  if (axis.size == 1) return axis;
  const double least = kNegligible * *std::max_element(density.begin(), density.end());
  std::size_t first = 0, last = axis.size - 1;
  while (density[first] < least) ++first;
  while (density[last] < least) --last;
  return {axis.at(first == 0 ? 0 : first - 1), axis.at(std::min(last + 1, axis.size - 1)),
          axis.size};
}

/// The marginal on a sixteen times finer axis: its logarithm is nearly a parabola, so a cubic
/// through four neighbours of that keeps seven digits where one through the density would not.
std::vector<double> refined(Axis& axis, const std::vector<double>& density) {
  constexpr std::size_t kFiner = 16;
  constexpr double kSteep = 30.0;
  std::vector<double> logs;
  for (const double value : density) logs.push_back(std::log(std::max(value, 1e-300)));
  const std::size_t last = density.size() - 1;
  std::vector<double> finer;
  for (std::size_t i = 0; i < last; ++i) {
    const std::size_t from = std::clamp<std::size_t>(i, 1, last - 2) - 1;
    // Beside a value ruled out, such as a lapse rate of 0, a cubic would swing.
    const auto [least, most] =
        std::minmax_element(logs.begin() + static_cast<std::ptrdiff_t>(from),
                            logs.begin() + static_cast<std::ptrdiff_t>(from + 4));
    const bool smooth = *most - *least < kSteep;
    for (std::size_t part = 0; part < kFiner; ++part) {
      const double t = static_cast<double>(i - from) +
                       static_cast<double>(part) / static_cast<double>(kFiner);
      const double cubic = -logs[from] * (t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0 +
                           logs[from + 1] * t * (t - 2.0) * (t - 3.0) / 2.0 -
                           logs[from + 2] * t * (t - 1.0) * (t - 3.0) / 2.0 +
                           logs[from + 3] * t * (t - 1.0) * (t - 2.0) / 6.0;
      const double share = t - static_cast<double>(i - from);
      const double line = logs[i] + share * (logs[i + 1] - logs[i]);
      finer.push_back(std::exp(smooth ? cubic : line));
    }
  }
  finer.push_back(density[last]);
  axis.size = finer.size();
  return finer;
}

/// The density's integral up to each value, by the cubic through four neighbours.
std::vector<double> cumulated(const Axis& axis, const std::vector<double>& density) {
  const std::size_t n = density.size();
  std::vector<double> sum(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    double area = 0.0;
    if (i == 0) {
      area = 9.0 * density[0] + 19.0 * density[1] - 5.0 * density[2] + density[3];
    } else if (i + 2 == n) {
      area =
          9.0 * density[n - 1] + 19.0 * density[n - 2] - 5.0 * density[n - 3] + density[n - 4];
    } else {
      area = 13.0 * (density[i] + density[i + 1]) - density[i - 1] - density[i + 2];
    }
    sum[i + 1] = sum[i] + std::max(0.0, area) * axis.step() / 24.0;
  }
  return sum;
}

/// Where the integral reaches a probability.
double quantile_of(Axis axis, const std::vector<double>& coarse, double probability) {
  const std::vector<double> density = refined(axis, coarse);
  const std::vector<double> sum = cumulated(axis, density);
  const double wanted = probability * sum.back();
  std::size_t cell = 0;
  while (cell + 2 < sum.size() && sum[cell + 1] < wanted) ++cell;
  // Hermite's cubic through both ends with the density as slope, by bisection: it rises.
  const double h = axis.step(), from = sum[cell], to = sum[cell + 1];
  double low = 0.0, high = 1.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double t = 0.5 * (low + high), u = 1.0 - t;
    const double value = from * (1.0 + 2.0 * t) * u * u + to * t * t * (3.0 - 2.0 * t) +
                         h * t * u * (u * density[cell] - t * density[cell + 1]);
    (value < wanted ? low : high) = t;
  }
  return axis.at(cell) + h * 0.5 * (low + high);
}

/// Integral up to `x`: Hermite's cubic with the density as slope.
double cumulated_at(const Axis& axis, const std::vector<double>& density,
                    const std::vector<double>& sum, double x) {
  if (!(x > axis.low)) return 0.0;
  if (!(x < axis.high)) return sum.back();
  const double h = axis.step();
  const auto cell = std::min(static_cast<std::size_t>((x - axis.low) / h), sum.size() - 2);
  const double t = (x - axis.at(cell)) / h, u = 1.0 - t;
  return sum[cell] * (1.0 + 2.0 * t) * u * u + sum[cell + 1] * t * t * (3.0 - 2.0 * t) +
         h * t * u * (u * density[cell] - t * density[cell + 1]);
}

/// Over the intensity itself w is spread / pse: its distribution is that of ln spread, shifted
/// by ln pse, over all places. A pse that is not > 0 counts as w without bound.
class LinearFraction {
 public:
  LinearFraction(const PsychometricLevels& levels, const Axes& axes) : axis_(axes[0]) {
    std::vector<double> joint;
    (void)marginals_over(levels, axes, &joint);
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

std::string words_of_priors(const PsychometricLevels& levels, const FreeParameters& free) {
  const std::string of = levels.logarithmic() ? "logarithms of the levels" : "levels";
  std::string words = "ln spread of the curve uniform from a quarter of the smallest step " +
                      std::string(free[1] ? "between" : "from the reference among") + " the " +
                      of + " to four times their range";
  if (free[1]) words += "; pse uniform within their range and half of it to either side";
  if (free[2]) words += "; lapse rate Beta(1, 10) below 0.5";
  return words;
}

}  // namespace

PsychometricPosterior posterior_on_grid(const PsychometricLevels& levels,
                                        const FreeParameters& free) {
  PsychometricPosterior posterior;
  posterior.status = FitStatus::kDegenerate;
  posterior.reason = why_unidentified(levels, free[1], free[2]);
  if (posterior.reason.empty() && levels.zero_yes > 0.0 && !free[2]) {
    posterior.reason = "impossible: a yes at intensity 0 has probability 0 without lapses";
  }
  if (!posterior.reason.empty()) return posterior;
  const Axes prior = prior_axes(levels, free);
  Axes axes = prior;
  Marginals marginals = marginals_over(levels, axes);
  for (int narrowing = 0; narrowing < 3; ++narrowing) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      axes[axis] = narrowed(axes[axis], marginals[axis]);
    }
    marginals = marginals_over(levels, axes);
  }
  const auto quantile = [&](std::size_t axis, double probability) {
    return quantile_of(axes[axis], marginals[axis], probability);
  };
  posterior.status = FitStatus::kOk;
  posterior.priors = words_of_priors(levels, free);
  if (levels.logarithmic()) {
    const auto fraction = [&](double probability) {
      return levels.weber_fraction_at(std::exp(-quantile(0, probability)), levels.origin);
    };
    posterior.weber_fraction = fraction(0.5);
    posterior.weber_fraction_ci95 = {fraction(0.025), fraction(0.975)};
  } else {
    const LinearFraction fraction(levels, axes);
    posterior.weber_fraction = fraction.quantile(0.5);
    posterior.weber_fraction_ci95 = {fraction.quantile(0.025), fraction.quantile(0.975)};
  }
  if (free[1]) {
    posterior.pse = levels.intensity_at(quantile(1, 0.5));
    posterior.pse_ci95 = Interval{levels.intensity_at(quantile(1, 0.025)),
                                  levels.intensity_at(quantile(1, 0.975))};
  }
  if (free[2]) posterior.lapse_rate = quantile(2, 0.5);
  // Density left at an end of the prior: what lies beyond was ruled out beforehand.
  constexpr double kLeftOver = 0.01;
  const double highest = *std::max_element(marginals[0].begin(), marginals[0].end());
  const double near = 0.5 * axes[0].step();
  const bool at_low =
      axes[0].low < prior[0].low + near && marginals[0].front() > kLeftOver * highest;
  const bool at_high =
      axes[0].high > prior[0].high - near && marginals[0].back() > kLeftOver * highest;
  if (at_low || at_high) {
    if (at_low) posterior.weber_fraction_ci95.low.reset();
    if (at_high) posterior.weber_fraction_ci95.high.reset();
    posterior.note =
        "the answers do not bound the Weber fraction within the prior: value and interval rest "
        "on it, and the end concerned is open";
  }
  return posterior;
}

}  // namespace jnd::analysis
