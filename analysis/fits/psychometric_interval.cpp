#include "analysis/fits/psychometric_interval.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "analysis/fits/profile_crossing.h"
#include "analysis/fits/psychometric_limits.h"

namespace jnd::analysis {
namespace {

/// exp of a larger number would leave the range of double.
constexpr double kLargestLog = 700.0;
/// A curve is a step if neighbouring levels lie this many z apart.
constexpr double kStepZ = 40.0;
/// A curve over the intensity itself is flat if it rises less than this from end to end.
constexpr double kFlattestLinear = 1e-6;
/// The Weber fraction of a curve over the intensity itself does not exist beyond this limit,
/// because the pse is nearly 0.
constexpr double kLargestLinearFraction = 1e6;

/// Runs Newton's method from one curve and, if there can be several minima, from further
/// curves, and keeps the lowest cost. If the lapse rate is free, one further start has a larger
/// lapse rate. The likelihood of a curve with known guesses or lapses is not concave, so the
/// search also starts from `others`.
PsychometricOptimum lowest_from(const PsychometricLevels& levels, PsychometricMethod method,
                                const FreeParameters& free, const PsychometricCurve& start,
                                const std::vector<PsychometricCurve>& others) {
  PsychometricOptimum best = minimised_by_newton(levels, method, free, start);
  const auto consider = [&](const PsychometricCurve& from) {
    const PsychometricOptimum other = minimised_by_newton(levels, method, free, from);
    if (other.cost.value < best.cost.value) best = other;
  };
  if (free[2]) {
    PsychometricCurve with_lapses = start;
    with_lapses.lapse = std::min(0.05, 0.5 * levels.ends.lapse_limit());
    consider(with_lapses);
  }
  for (const PsychometricCurve& other : others) consider(other);
  return best;
}

/// Whether the cost can have several minima because of its known guesses or lapses.
bool has_ends_of_its_own(const PsychometricLevels& levels) noexcept {
  return levels.ends.guess > 0.0 || levels.ends.known_lapse > 0.0;
}

/// The cost at a given slope, minimised over the other free parameters. It follows the optimum
/// as the slope moves, because with lapses there can be several.
class SlopeProfile {
 public:
  SlopeProfile(const PsychometricLevels& levels, PsychometricMethod method,
               const FreeParameters& free, const PsychometricCurve& start)
      : levels_(levels), method_(method), free_{false, free[1], free[2]}, last_(start) {}

  double operator()(double log_slope) {
    const double slope = std::exp(log_slope);
    const PsychometricCurve start = {slope, last_.offset * (slope / last_.slope), last_.lapse};
    if (!free_[1] && !free_[2]) return psychometric_cost(levels_, method_, start).value;
    std::vector<PsychometricCurve> others;
    if (free_[1] && has_ends_of_its_own(levels_)) {
      for (const double u : levels_.abscissa)
        others.push_back({slope, -slope * u, start.lapse});
    }
    const PsychometricOptimum best = lowest_from(levels_, method_, free_, start, others);
    last_ = best.curve;
    return best.cost.value;
  }

 private:
  const PsychometricLevels& levels_;
  PsychometricMethod method_;
  FreeParameters free_;
  PsychometricCurve last_;
};

/// The cost of a curve over the intensity itself at a given Weber fraction, minimised over the
/// other free parameters. The abscissa's origin is at intensity 0, so the offset is -jnd / w
/// for every slope.
class LinearFractionProfile {
 public:
  LinearFractionProfile(const PsychometricLevels& levels, PsychometricMethod method,
                        const FreeParameters& free, const PsychometricCurve& start)
      : levels_(from_zero(levels)),
        method_(method),
        free_{true, false, free[2]},
        last_{start.slope, start.offset - start.slope * levels.origin / levels.unit,
              start.lapse} {}

  /// ln(1 / w) of the curve from which the profile starts.
  [[nodiscard]] double start() const noexcept {
    return std::log(-last_.offset / sigmoid_jnd(levels_.sigmoid));
  }

  double operator()(double minus_log_fraction) {
    const double offset = -sigmoid_jnd(levels_.sigmoid) * std::exp(minus_log_fraction);
    // The start has the same pse with a steeper or flatter curve.
    const PsychometricCurve start = {last_.slope * offset / last_.offset, offset, last_.lapse};
    std::vector<PsychometricCurve> others;
    if (has_ends_of_its_own(levels_)) {
      for (const double factor : {0.5, 2.0}) {
        others.push_back({factor * start.slope, offset, start.lapse});
      }
    }
    const PsychometricOptimum best = lowest_from(levels_, method_, free_, start, others);
    last_ = best.curve;
    return best.cost.value;
  }

 private:
  static PsychometricLevels from_zero(PsychometricLevels levels) {
    for (double& place : levels.abscissa) place += levels.origin / levels.unit;
    return levels;
  }

  PsychometricLevels levels_;
  PsychometricMethod method_;
  FreeParameters free_;
  PsychometricCurve last_;
};

/// The cost at a given pse, as a function of `place` = ln(pse / origin) / unit.
class PseProfile {
 public:
  PseProfile(const PsychometricLevels& levels, PsychometricMethod method,
             const FreeParameters& free, const PsychometricCurve& start)
      : levels_(levels),
        shifted_(levels),
        method_(method),
        free_{true, false, free[2]},
        last_{start.slope, 0.0, start.lapse} {}

  double operator()(double place) {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      shifted_.abscissa[level] = levels_.abscissa[level] - place;
    }
    // At this pse the best slope may be 0 or infinite although it is neither at the optimum.
    double best = std::min(flat_limit_cost(shifted_, method_, false, free_[2]),
                           step_limit_cost(shifted_, method_, false, free_[2]));
    PsychometricOptimum found = minimised_by_newton(shifted_, method_, free_, last_);
    if (has_ends_of_its_own(levels_)) {
      for (const double factor : {0.25, 4.0}) {
        PsychometricCurve other = last_;
        other.slope *= factor;
        const PsychometricOptimum there = minimised_by_newton(shifted_, method_, free_, other);
        if (there.cost.value < found.cost.value) found = there;
      }
    }
    if (found.cost.value < best) {
      best = found.cost.value;
      last_ = found.curve;
    }
    return best;
  }

 private:
  const PsychometricLevels& levels_;
  PsychometricLevels shifted_;
  PsychometricMethod method_;
  FreeParameters free_;
  PsychometricCurve last_;
};

Interval linear_interval(const PsychometricLevels& levels, PsychometricMethod method,
                         const FreeParameters& free, const PsychometricOptimum& optimum,
                         double drop) {
  const double level = optimum.cost.value + drop;
  const LinearFractionProfile at_optimum(levels, method, free, optimum.curve);
  const double from = at_optimum.start();
  const double steepest =
      from + std::log(kStepZ / (optimum.curve.slope * levels.smallest_gap(free[1])));
  const auto end = [&](double limit) -> std::optional<double> {
    LinearFractionProfile profile = at_optimum;
    const std::optional<double> found =
        crossing([&](double place) { return profile(place) - level; }, from, 0.1, limit);
    return found ? std::optional(std::exp(-*found)) : std::nullopt;
  };
  return {.low = end(std::max(steepest, from + 1.0)),
          .high = end(std::min(-std::log(kLargestLinearFraction), from))};
}

}  // namespace

Interval weber_fraction_interval(const PsychometricLevels& levels, PsychometricMethod method,
                                 const FreeParameters& free, const PsychometricOptimum& optimum,
                                 double drop) {
  if (!levels.logarithmic()) return linear_interval(levels, method, free, optimum, drop);
  const double level = optimum.cost.value + drop;
  const double log_slope = std::log(optimum.curve.slope);
  const double flattest = std::log(levels.unit / kLargestLog);
  const double steepest = std::log(kStepZ / levels.smallest_gap(free[1]));
  const auto end = [&](double limit) -> std::optional<double> {
    SlopeProfile profile(levels, method, free, optimum.curve);
    const std::optional<double> found =
        crossing([&](double place) { return profile(place) - level; }, log_slope, 0.1, limit);
    if (!found) return std::nullopt;
    return levels.weber_fraction_at(std::exp(*found), optimum.curve.pse(levels));
  };
  return {.low = end(std::max(steepest, log_slope + 1.0)),
          .high = end(std::min(flattest, log_slope))};
}

Interval pse_interval(const PsychometricLevels& levels, PsychometricMethod method,
                      const FreeParameters& free, const PsychometricOptimum& optimum,
                      double drop) {
  const double level = optimum.cost.value + drop;
  const double place = -optimum.curve.offset / optimum.curve.slope;
  const auto end = [&](double limit) -> std::optional<double> {
    PseProfile profile(levels, method, free, optimum.curve);
    const std::optional<double> found = crossing([&](double at) { return profile(at) - level; },
                                                 place, 0.1 / optimum.curve.slope, limit);
    const double pse = levels.intensity_at(found.value_or(0.0));
    const bool usable = std::isfinite(pse) && (pse > 0.0 || !levels.logarithmic());
    return found && usable ? std::optional<double>(pse) : std::nullopt;
  };
  const double farthest =
      std::max(levels.logarithmic() ? kLargestLog / levels.unit : 1.0 / kFlattestLinear,
               std::fabs(place));
  return {.low = end(-farthest), .high = end(farthest)};
}

}  // namespace jnd::analysis
