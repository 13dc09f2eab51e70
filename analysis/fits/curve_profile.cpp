#include "analysis/fits/curve_profile.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/fits/profile_crossing.h"

namespace jnd::analysis {
namespace {

using Kind = CurveQuantity::Kind;
using Cost = std::function<double(double)>;

constexpr double kPrecision = 1e-10;
/// A curve is a step if neighbouring levels lie this many z apart.
constexpr double kSteepestZ = 40.0;
/// A curve is flat if it rises less than this from end to end.
constexpr double kFlattest = 1e-6;
constexpr double kSomeRate = 0.03;

/// Runs Newton's method from several curves and keeps the lowest cost.
class LowestCost {
 public:
  LowestCost(const FreeParameters& free, const PsychometricOptimum& optimum)
      : free_(free), last_(optimum.curve), first_(optimum.curve) {}

  /// `prepare` sets the parameters of a curve that are held.
  double operator()(const PsychometricLevels& levels,
                    const std::function<void(PsychometricCurve&)>& prepare) {
    PsychometricOptimum best;
    best.cost.value = std::numeric_limits<double>::infinity();
    const auto consider = [&](PsychometricCurve start) {
      prepare(start);
      const PsychometricOptimum found =
          minimised_by_newton(levels, PsychometricMethod::kMaximumLikelihood, free_, start);
      if (found.cost.value < best.cost.value) best = found;
    };
    consider(last_);
    if (!levels.ends.are_bare(free_[2])) {
      consider(first_);
      // On its bound a rate may wrongly seem to be at rest, so the search also starts inside.
      PsychometricCurve inside = last_;
      if (free_[2]) inside.lapse = std::max(inside.lapse, kSomeRate);
      if (free_[3]) inside.guess = std::max(inside.guess, kSomeRate);
      consider(inside);
      if (free_[0]) {
        inside.slope *= 3.0;
        consider(inside);
      }
    }
    if (best.converged) last_ = best.curve;
    return best.cost.value;
  }

 private:
  FreeParameters free_;
  PsychometricCurve last_, first_;
};

/// Finds both ends of an interval from a cost along one coordinate, whose optimum is at `at`.
struct Coordinate {
  double at = 0.0, step = 0.1, lowest = 0.0, highest = 0.0;
};
Interval ends_of(const std::function<Cost()>& make_cost, const Coordinate& along,
                 double level) {
  const auto end = [&](double limit) -> std::optional<double> {
    const Cost cost = make_cost();
    return crossing([&](double place) { return cost(place) - level; }, along.at, along.step,
                    limit, kPrecision);
  };
  return {.low = end(std::min(along.lowest, along.at)),
          .high = end(std::max(along.highest, along.at))};
}

class CurveProfile {
 public:
  CurveProfile(const CurveModel& model, const PsychometricLevels& levels,
               const FreeParameters& free, const PsychometricOptimum& optimum, double drop)
      : model_(model),
        levels_(levels),
        free_(free),
        optimum_(optimum),
        level_(optimum.cost.value + drop) {}

  /// The interval of the place on the abscissa where F has this probability.
  [[nodiscard]] Interval place(double probability) const {
    const double z = sigmoid_quantile(levels_.sigmoid, probability);
    const auto make = [&]() -> Cost {
      LowestCost lowest({true, false, free_[2], free_[3]}, optimum_);
      return [this, lowest, z, shifted = levels_](double at) mutable {
        for (std::size_t i = 0; i < shifted.size(); ++i) {
          shifted.abscissa[i] = levels_.abscissa[i] - at;
        }
        return lowest(shifted, [z](PsychometricCurve& curve) { curve.offset = z; });
      };
    };
    const double at = (z - optimum_.curve.offset) / optimum_.curve.slope;
    const double farthest = std::max(1e3, 100.0 * std::fabs(at));
    return ends_of(make, {at, 0.2 / optimum_.curve.slope, -farthest, farthest}, level_);
  }

  /// The interval of ln slope.
  [[nodiscard]] Interval log_slope() const {
    const auto make = [&]() -> Cost {
      LowestCost lowest({false, true, free_[2], free_[3]}, optimum_);
      return [this, lowest](double log_slope) mutable {
        const double slope = std::exp(log_slope);
        return lowest(levels_, [slope](PsychometricCurve& curve) {
          curve.offset *= slope / curve.slope;
          curve.slope = slope;
        });
      };
    };
    const double at = std::log(optimum_.curve.slope);
    const double steepest = std::log(kSteepestZ / levels_.smallest_gap(true));
    return ends_of(make, {at, 0.1, std::log(kFlattest), std::max(steepest, at + 1.0)}, level_);
  }

  /// The interval of the engine's lapse or guess rate.
  [[nodiscard]] Interval rate(bool is_lapse) const {
    const auto make = [&]() -> Cost {
      FreeParameters others = free_;
      others[is_lapse ? 2 : 3] = false;
      LowestCost lowest(others, optimum_);
      return [this, lowest, is_lapse](double rate) mutable {
        return lowest(levels_, [rate, is_lapse](PsychometricCurve& curve) {
          (is_lapse ? curve.lapse : curve.guess) = rate;
        });
      };
    };
    const double at = is_lapse ? optimum_.curve.lapse : optimum_.curve.guess;
    const double limit = is_lapse ? levels_.ends.largest_lapse() : levels_.ends.largest_guess();
    Interval ends = ends_of(make, {at, 0.01, 0.0, limit}, level_);
    if (!ends.low) ends.low = 0.0;
    if (!ends.high) ends.high = limit;
    return ends;
  }

  /// The interval of the logarithm of a quantity that depends on slope, place and rates
  /// together, so that no single parameter of the engine stands for it. For the threshold of a
  /// proportion, which may be negative, it is the interval of the place itself.
  [[nodiscard]] Interval logarithm(const CurveQuantity& quantity) const {
    const SmoothCost cost = [&](std::span<const double> x, double& value,
                                std::span<double> gradient) {
      PsychometricCurve curve;
      if (!curve_at(quantity, x, curve)) return false;
      const PsychometricCost here =
          psychometric_cost(levels_, PsychometricMethod::kMaximumLikelihood, curve);
      value = here.value;
      std::vector<double> moved(x.begin(), x.end());
      for (std::size_t i = 0; i < x.size(); ++i) {
        constexpr double kStep = 1e-6;
        PsychometricCurve above, below;
        moved[i] = x[i] + kStep;
        const bool has_above = curve_at(quantity, moved, above);
        moved[i] = x[i] - kStep;
        const bool has_below = curve_at(quantity, moved, below);
        moved[i] = x[i];
        if (!has_above || !has_below) return false;
        gradient[i] = (here.gradient(0) * (above.slope - below.slope) +
                       here.gradient(1) * (above.offset - below.offset) +
                       here.gradient(2) * (above.lapse - below.lapse) +
                       here.gradient(3) * (above.guess - below.guess)) /
                      (2.0 * kStep);
      }
      return std::isfinite(value);
    };
    const LikelihoodOptimum from = {coordinates(quantity, 0.0), optimum_.cost.value, true};
    std::vector<std::vector<double>> starts;
    if (free_[2] || free_[3]) starts.push_back(coordinates(quantity, kSomeRate));
    constexpr double kFarthest = 12.0;
    return likelihood_ratio_interval(cost, from, starts, 0, kFarthest,
                                     level_ - optimum_.cost.value);
  }

 private:
  static double angle(double rate, double limit) {
    return std::asin(std::sqrt(std::clamp(rate / limit, 0.0, 1.0)));
  }
  static double rate_at(double angle, double limit) {
    return limit * std::sin(angle) * std::sin(angle);
  }

  /// The optimum in these coordinates: ln of the quantity, the place on the abscissa where F
  /// has its level (F = 0.5 for a distance), and the angles of the free rates. Rates below
  /// `least_rate` are raised to it.
  [[nodiscard]] std::vector<double> coordinates(const CurveQuantity& quantity,
                                                double least_rate) const {
    const PsychometricCurve& curve = optimum_.curve;
    const double level =
        quantity.kind == Kind::kDistance ? 0.5 : level_of_f_at(quantity, curve);
    const double place =
        (sigmoid_quantile(levels_.sigmoid, level) - curve.offset) / curve.slope;
    std::vector<double> x;
    if (quantity.kind == Kind::kThresholdOfProportion) {
      x = {place, std::log(curve.slope)};
    } else {
      x = {std::log(std::fabs(value_of(quantity, model_, levels_, curve))), place};
    }
    const PsychometricEnds& ends = levels_.ends;
    if (free_[2]) x.push_back(angle(std::max(curve.lapse, least_rate), ends.largest_lapse()));
    if (free_[3]) x.push_back(angle(std::max(curve.guess, least_rate), ends.largest_guess()));
    return x;
  }

  /// The value of F at the quantity's place on a curve with these rates.
  [[nodiscard]] double level_of_f_at(const CurveQuantity& quantity,
                                     const PsychometricCurve& curve) const {
    const bool is_of_proportion = quantity.kind == Kind::kThresholdOfProportion ||
                                  quantity.kind == Kind::kSlopeOfProportion;
    return is_of_proportion ? level_of_proportion(model_, levels_, curve, quantity.level)
                            : quantity.level;
  }

  bool curve_at(const CurveQuantity& quantity, std::span<const double> x,
                PsychometricCurve& curve) const {
    std::size_t next = 2;
    const PsychometricEnds& ends = levels_.ends;
    curve.lapse = free_[2] ? rate_at(x[next++], ends.largest_lapse()) : optimum_.curve.lapse;
    curve.guess = free_[3] ? rate_at(x[next++], ends.largest_guess()) : optimum_.curve.guess;
    const double level = level_of_f_at(quantity, curve);
    if (!(level > 0.0 && level < 1.0)) return false;
    const double z = sigmoid_quantile(levels_.sigmoid, level);
    if (quantity.kind == Kind::kThresholdOfProportion) {
      curve.slope = std::exp(x[1]);
      curve.offset = z - curve.slope * x[0];
      return curve.slope > 0.0 && std::isfinite(curve.slope) && std::isfinite(curve.offset);
    }
    const double value = std::exp(x[0]), at = levels_.intensity_at(x[1]);
    if (quantity.kind == Kind::kDistance) {
      // The value is x_level - x_0.5, which on a logarithmic axis is x_0.5 (e^(z unit / slope)
      // - 1).
      const double step = levels_.logarithmic() ? std::log1p(std::copysign(value, z) / at)
                                                : std::copysign(value, z);
      curve.slope = z * levels_.unit / step;
      curve.offset = -curve.slope * x[1];
    } else {
      const double density = sigmoid_tails(levels_.sigmoid, z).density;
      const double rise = ends.rise(curve.lapse, curve.guess);
      curve.slope =
          value * levels_.unit * (levels_.logarithmic() ? at : 1.0) / (rise * density);
      curve.offset = z - curve.slope * x[1];
    }
    return curve.slope > 0.0 && std::isfinite(curve.slope) && std::isfinite(curve.offset);
  }

  const CurveModel& model_;
  const PsychometricLevels& levels_;
  FreeParameters free_;
  const PsychometricOptimum& optimum_;
  double level_;
};

Interval mapped(const Interval& ends, const std::function<double(double)>& map) {
  const auto end = [&](const std::optional<double>& value) -> std::optional<double> {
    if (!value) return std::nullopt;
    const double there = map(*value);
    return std::isfinite(there) ? std::optional(there) : std::nullopt;
  };
  return {end(ends.low), end(ends.high)};
}

Interval turned(const Interval& ends) { return {ends.high, ends.low}; }

}  // namespace

Interval profile_interval(const CurveQuantity& quantity, const CurveModel& model,
                          const PsychometricLevels& levels, const FreeParameters& free,
                          const PsychometricOptimum& optimum, double drop) {
  const CurveProfile profile(model, levels, free, optimum, drop);
  const auto by_slope = [&](double log_slope) {
    PsychometricCurve curve = optimum.curve;
    curve.offset *= std::exp(log_slope) / curve.slope;  // The place of F = 0.5 stays the same.
    curve.slope = std::exp(log_slope);
    return value_of(quantity, model, levels, curve);
  };
  const bool falls_with_slope =
      quantity.kind == Kind::kDistance ||
      (quantity.kind == Kind::kScale && model.family != CurveFamily::kWeibull);
  switch (quantity.kind) {
    case Kind::kThreshold:
      return mapped(profile.place(quantity.level),
                    [&](double place) { return levels.intensity_at(place); });
    case Kind::kLocation:
      return mapped(profile.place(traits_of(model.family).at_location), [&](double place) {
        return model.family == CurveFamily::kWeibull || !levels.logarithmic()
                   ? levels.intensity_at(place)
                   : std::log(levels.origin) + place * levels.unit;
      });
    case Kind::kGuess:
    case Kind::kLapse: {
      // A falling curve has its rates exchanged.
      const bool is_lapse = model.symmetric || (quantity.kind == Kind::kLapse) != model.falling;
      return free[is_lapse ? 2 : 3] ? profile.rate(is_lapse) : Interval{};
    }
    case Kind::kThresholdOfProportion:
      return mapped(profile.logarithm(quantity),
                    [&](double place) { return levels.intensity_at(place); });
    case Kind::kSlopeOfProportion: {
      const Interval ends = mapped(profile.logarithm(quantity), [&](double log_value) {
        return model.falling ? -std::exp(log_value) : std::exp(log_value);
      });
      return model.falling ? turned(ends) : ends;
    }
    case Kind::kScale:
    case Kind::kDistance:
    case Kind::kSlope:
      break;
  }
  const bool has_rates = free[2] || free[3];
  if (quantity.kind != Kind::kScale &&
      (levels.logarithmic() || (quantity.kind == Kind::kSlope && has_rates))) {
    const Interval ends = mapped(profile.logarithm(quantity), [&](double log_value) {
      const double value = std::exp(log_value);
      return quantity.kind == Kind::kSlope && model.falling ? -value : value;
    });
    return quantity.kind == Kind::kSlope && model.falling ? turned(ends) : ends;
  }
  const Interval ends = mapped(profile.log_slope(), by_slope);
  const bool turns = falls_with_slope || (quantity.kind == Kind::kSlope && model.falling);
  return turns ? turned(ends) : ends;
}

}  // namespace jnd::analysis
