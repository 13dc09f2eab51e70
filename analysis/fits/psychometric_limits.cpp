#include "analysis/fits/psychometric_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jnd::analysis {
namespace {

using enum PsychometricMethod;

/// Levels that share one probability f, as a weighted count. Maximum likelihood counts answers,
/// and least squares counts levels.
struct Pool {
  double yes = 0.0, total = 0.0;
  /// The sum of squares of the levels' shares about their mean, updated so that nothing
  /// cancels.
  double squares = 0.0;

  void add(double num_yes, double num_trials, PsychometricMethod method) noexcept {
    const double weight = method == kMaximumLikelihood ? 1.0 : 1.0 / num_trials;
    const double share = num_yes * weight;
    const double distance = share - mean();
    if (total > 0.0) squares += distance * distance * total / (total + 1.0);
    yes += share;
    total += num_trials * weight;
  }
  /// The cost if all pooled levels have probability f.
  [[nodiscard]] double cost(double f, PsychometricMethod method) const noexcept {
    if (method == PsychometricMethod::kLeastSquares) {
      return squares + total * (mean() - f) * (mean() - f);
    }
    double value = 0.0;
    if (yes > 0.0) value -= yes * std::log(f);
    if (total - yes > 0.0) value -= (total - yes) * std::log1p(-f);
    return value;
  }
  [[nodiscard]] double mean() const noexcept { return total > 0.0 ? yes / total : 0.0; }
};

/// Clamps a value to [low, high], and to low if rounding has made high smaller than low.
double within(double value, double low, double high) noexcept {
  return std::min(std::max(value, low), std::max(low, high));
}

/// The probability f without lapses where F = `lower`. `by_lapse` is its derivative by the
/// lapse rate.
double without_lapses(const PsychometricEnds& ends, double lower) noexcept {
  return ends.guess == 0.0 ? lower : ends.guess + (1.0 - ends.guess) * lower;
}
double by_lapse(const PsychometricEnds& ends, double lower) noexcept {
  return ends.symmetric ? 1.0 - 2.0 * lower : -lower;
}

Pool pool_at_zero(const PsychometricLevels& levels, PsychometricMethod method) {
  Pool pool;
  if (levels.zero_trials > 0.0) pool.add(levels.zero_yes, levels.zero_trials, method);
  return pool;
}

/// The derivative of minus the log-likelihood by the lapse rate.
double lapse_gradient(const PsychometricLevels& levels, double lapse,
                      const double* lower_tail) noexcept {
  const PsychometricEnds& ends = levels.ends;
  double sum = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double gain = by_lapse(ends, lower_tail[level]);
    const double f = without_lapses(ends, lower_tail[level]) + lapse * gain;
    const double yes = levels.num_yes[level];
    const double no = levels.num_trials[level] - yes;
    if (yes > 0.0) sum -= yes * gain / f;
    if (no > 0.0) sum += no * gain / (1.0 - f);
  }
  if (!ends.symmetric) return sum;
  const double low = ends.low(lapse);
  if (levels.zero_yes > 0.0) sum -= levels.zero_yes / low;
  return sum + (levels.zero_trials - levels.zero_yes) / (1.0 - low);
}

double likelihood_lapse(const PsychometricLevels& levels, const double* lower_tail) noexcept {
  double low = 0.0, high = levels.ends.lapse_limit();
  if (!(lapse_gradient(levels, low, lower_tail) < 0.0)) return 0.0;
  if (lapse_gradient(levels, high, lower_tail) < 0.0) return high;
  // A precision of 1e-3 is enough for a start of Newton's method.
  for (int halving = 0; halving < 9; ++halving) {
    const double middle = 0.5 * (low + high);
    (lapse_gradient(levels, middle, lower_tail) < 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double least_squares_lapse(const PsychometricLevels& levels,
                           const double* lower_tail) noexcept {
  const PsychometricEnds& ends = levels.ends;
  double numerator = 0.0, denominator = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double gain = by_lapse(ends, lower_tail[level]);
    numerator += gain * (levels.proportion(level) - without_lapses(ends, lower_tail[level]));
    denominator += gain * gain;
  }
  if (levels.zero_trials > 0.0 && ends.symmetric) {
    numerator += levels.zero_yes / levels.zero_trials - ends.guess;
    denominator += 1.0;
  }
  return denominator > 0.0 ? std::clamp(numerator / denominator, 0.0, ends.lapse_limit()) : 0.0;
}

/// The least value of a cost that is convex in the lapse rate over [0, limit], by golden
/// sections. The value is nearly exact, because the cost is flat near its minimum.
template <typename Cost>
double least_over_lapse(const PsychometricEnds& ends, const Cost& cost) {
  constexpr double kGolden = 0.6180339887498949;
  double low = 0.0, high = ends.lapse_limit();
  const double best_end = std::min(cost(low), cost(high));
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = cost(left), at_right = cost(right);
  for (int section = 0; section < 60; ++section) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = cost(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = cost(right);
    }
  }
  return std::min({best_end, at_left, at_right});
}

/// Whether lapses are the same kind of error at both ends, so that one closed form covers all
/// errors.
bool pool_as_errors(const PsychometricEnds& ends, bool free_lapse) noexcept {
  return ends.symmetric && ends.guess == 0.0 && (free_lapse || ends.known_lapse == 0.0);
}

/// The cost of a step if its two ends do not share their errors.
double step_between_ends(const PsychometricLevels& levels, PsychometricMethod method,
                         std::size_t num_below, bool level_at, bool free_pse, bool free_lapse) {
  const Pool zero = pool_at_zero(levels, method);
  Pool below = zero, at, above;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    Pool& pool = level < num_below ? below : level_at && level == num_below ? at : above;
    pool.add(levels.num_yes[level], levels.num_trials[level], method);
  }
  const PsychometricEnds& ends = levels.ends;
  if (!ends.symmetric && free_pse) {
    // Each end has levels of its own, so it is best at their mean.
    const double least_high = ends.free_guess ? 1.0 - ends.lapse_limit() : ends.guess;
    double high = 1.0 - ends.known_lapse;
    if (free_lapse) high = above.total > 0.0 ? within(above.mean(), least_high, 1.0) : 1.0;
    const double low = ends.free_guess
                           ? within(below.mean(), 0.0, std::min(ends.guess_limit(), high))
                           : ends.guess;
    return below.cost(low, method) + at.cost(within(at.mean(), low, high), method) +
           above.cost(high, method);
  }
  const auto cost = [&](double lapse) {
    const double low = ends.low(lapse), high = low + ends.rise(lapse);
    const double at_threshold =
        free_pse ? std::clamp(at.mean(), low, std::max(low, high)) : ends.middle(lapse);
    return below.cost(low, method) + at.cost(at_threshold, method) + above.cost(high, method);
  };
  return free_lapse ? least_over_lapse(ends, cost) : cost(ends.known_lapse);
}

double flat_between_ends(const PsychometricLevels& levels, PsychometricMethod method,
                         bool free_pse, bool free_lapse) {
  const Pool zero = pool_at_zero(levels, method);
  Pool rest;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    rest.add(levels.num_yes[level], levels.num_trials[level], method);
  }
  const PsychometricEnds& ends = levels.ends;
  if (!ends.symmetric && free_pse) {
    const double high = free_lapse ? 1.0 : 1.0 - ends.known_lapse;
    double low = ends.guess;
    if (ends.free_guess) {
      low =
          zero.total > 0.0 ? within(zero.mean(), 0.0, std::min(ends.guess_limit(), high)) : 0.0;
    }
    return zero.cost(low, method) + rest.cost(within(rest.mean(), low, high), method);
  }
  const auto cost = [&](double lapse) {
    const double low = ends.low(lapse), high = low + ends.rise(lapse);
    const double f =
        free_pse ? std::clamp(rest.mean(), low, std::max(low, high)) : ends.middle(lapse);
    return zero.cost(low, method) + rest.cost(f, method);
  };
  return free_lapse ? least_over_lapse(ends, cost) : cost(ends.known_lapse);
}

/// The ends that are best for given F(z) at each level, by the EM algorithm: an answer belongs
/// to the upper end with probability F, and to the lower end otherwise. It serves as a start of
/// Newton's method, so an approximation is enough.
BestLapse best_ends(const PsychometricLevels& levels, bool free_lapse,
                    const double* lower_tail) noexcept {
  constexpr int kNumSteps = 12;
  constexpr double kSmallest = 1e-4;
  const PsychometricEnds& ends = levels.ends;
  double low = std::min(0.1, 0.5 * ends.guess_limit());
  double high = free_lapse ? 0.95 : 1.0 - ends.known_lapse;
  double cost = 0.0;
  for (int step = 0; step <= kNumSteps; ++step) {
    double low_yes = levels.zero_yes, low_all = levels.zero_trials, high_yes = 0.0,
           high_all = 0.0;
    cost = 0.0;
    if (levels.zero_yes > 0.0) cost -= levels.zero_yes * std::log(low);
    cost -= (levels.zero_trials - levels.zero_yes) * std::log1p(-low);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const double upper_share = lower_tail[level];
      const double f = low + (high - low) * upper_share;
      const double yes = levels.num_yes[level], no = levels.num_trials[level] - yes;
      if (yes > 0.0) {
        const double of_high = yes * high * upper_share / f;
        cost -= yes * std::log(f);
        high_yes += of_high;
        high_all += of_high;
        low_yes += yes - of_high;
        low_all += yes - of_high;
      }
      if (no > 0.0) {
        const double of_high = no * (1.0 - high) * upper_share / (1.0 - f);
        cost -= no * std::log(1.0 - f);
        high_all += of_high;
        low_all += no - of_high;
      }
    }
    if (step == kNumSteps) break;
    if (low_all > 0.0) low = within(low_yes / low_all, kSmallest, ends.guess_limit() - 0.01);
    if (free_lapse && high_all > 0.0) {
      high = within(high_yes / high_all, 1.01 - ends.lapse_limit(), 1.0 - kSmallest);
    }
  }
  return {free_lapse ? 1.0 - high : ends.known_lapse, cost, low};
}

}  // namespace

BestLapse best_lapse(const PsychometricLevels& levels, PsychometricMethod method,
                     bool free_lapse, const double* lower_tail) noexcept {
  const PsychometricEnds& ends = levels.ends;
  if (ends.free_guess) return best_ends(levels, free_lapse, lower_tail);
  double lapse = ends.known_lapse;
  if (free_lapse) {
    lapse = method == kMaximumLikelihood ? likelihood_lapse(levels, lower_tail)
                                         : least_squares_lapse(levels, lower_tail);
  }
  double cost = pool_at_zero(levels, method).cost(ends.low(lapse), method);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double f =
        without_lapses(ends, lower_tail[level]) + lapse * by_lapse(ends, lower_tail[level]);
    if (method == kMaximumLikelihood) {
      const double yes = levels.num_yes[level];
      const double no = levels.num_trials[level] - yes;
      if (yes > 0.0) cost -= yes * std::log(f);
      if (no > 0.0) cost -= no * std::log(1.0 - f);
    } else {
      const double residual = f - levels.proportion(level);
      cost += residual * residual;
    }
  }
  return {lapse, cost, 0.0};
}

double step_limit_cost(const PsychometricLevels& levels, PsychometricMethod method,
                       bool free_pse, bool free_lapse) {
  // The cost if `num_below` levels lie below the threshold. With `level_at` the next level lies
  // at the threshold.
  const auto cost_with = [&](std::size_t num_below, bool level_at) {
    if (!pool_as_errors(levels.ends, free_lapse)) {
      return step_between_ends(levels, method, num_below, level_at, free_pse, free_lapse);
    }
    Pool errors = pool_at_zero(levels, method);
    Pool at;
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const double yes = levels.num_yes[level];
      const double trials = levels.num_trials[level];
      if (level < num_below) {
        errors.add(yes, trials, method);
      } else if (level_at && level == num_below) {
        at.add(yes, trials, method);
      } else {
        errors.add(trials - yes, trials, method);
      }
    }
    const double lapse = free_lapse ? std::min(errors.mean(), 0.5) : 0.0;
    const double at_threshold = free_pse ? std::clamp(at.mean(), lapse, 1.0 - lapse) : 0.5;
    return errors.cost(lapse, method) + at.cost(at_threshold, method);
  };
  if (!free_pse) {
    const auto first_at = std::lower_bound(levels.abscissa.begin(), levels.abscissa.end(), 0.0);
    const bool level_at = first_at != levels.abscissa.end() && *first_at == 0.0;
    return cost_with(static_cast<std::size_t>(first_at - levels.abscissa.begin()), level_at);
  }
  // If the free value at a threshold would leave [lapse, 1 - lapse], the best curve has that
  // level below or above the threshold. Such curves are among the others.
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t num_below = 0; num_below <= levels.size(); ++num_below) {
    best = std::min(best, cost_with(num_below, false));
    if (num_below < levels.size()) best = std::min(best, cost_with(num_below, true));
  }
  return best;
}

double flat_limit_cost(const PsychometricLevels& levels, PsychometricMethod method,
                       bool free_pse, bool free_lapse) {
  if (!pool_as_errors(levels.ends, free_lapse)) {
    return flat_between_ends(levels, method, free_pse, free_lapse);
  }
  const Pool zero = pool_at_zero(levels, method);
  Pool rest;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    rest.add(levels.num_yes[level], levels.num_trials[level], method);
  }
  double lapse = free_lapse ? std::min(zero.mean(), 0.5) : 0.0;
  double f = free_pse ? rest.mean() : 0.5;
  if (free_pse && lapse > std::min(f, 1.0 - f)) {
    // The lapse rate may not exceed f or 1 - f. At best they are equal, which puts all levels
    // into one pool.
    const double pooled = zero.yes + (f < 0.5 ? rest.yes : rest.total - rest.yes);
    lapse = std::min(pooled / (zero.total + rest.total), 0.5);
    f = f < 0.5 ? lapse : 1.0 - lapse;
  }
  return zero.cost(lapse, method) + rest.cost(f, method);
}

}  // namespace jnd::analysis
