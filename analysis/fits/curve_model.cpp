#include "analysis/fits/curve_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr double kAtScale = 0.63212055882855767840;     // 1 - 1 / e
constexpr double kAtReversed = 0.36787944117144232160;  // 1 / e

/// The slope of z by the axis value, x or ln x.
double slope_by_axis(const PsychometricLevels& levels, const PsychometricCurve& curve) {
  return curve.slope / levels.unit;
}

double intensity_where(const PsychometricLevels& levels, const PsychometricCurve& curve,
                       double level) {
  return levels.intensity_at((sigmoid_quantile(levels.sigmoid, level) - curve.offset) /
                             curve.slope);
}

}  // namespace

const std::vector<CurveFamilyTraits>& curve_families() {
  static const std::vector<CurveFamilyTraits> families = {
      {CurveFamily::kNormal, "normal", "Phi(({} - location) / scale)", Sigmoid::kNormal, 0.5},
      {CurveFamily::kLogistic, "logistic", "1 / (1 + exp(-({} - location) / scale))",
       Sigmoid::kLogistic, 0.5},
      {CurveFamily::kWeibull, "weibull", "1 - exp(-(x / location)^scale)", Sigmoid::kWeibull,
       kAtScale},
      {CurveFamily::kGumbel, "gumbel", "1 - exp(-exp(({} - location) / scale))",
       Sigmoid::kWeibull, kAtScale},
      {CurveFamily::kReversedGumbel, "reversed_gumbel", "exp(-exp(-({} - location) / scale))",
       Sigmoid::kReversedGumbel, kAtReversed},
      {CurveFamily::kHyperbolicSecant, "hyperbolic_secant",
       "2 / pi arctan(exp(pi / 2 ({} - location) / scale))", Sigmoid::kHyperbolicSecant, 0.5},
  };
  return families;
}

const CurveFamilyTraits& traits_of(CurveFamily family) {
  return *std::ranges::find(curve_families(), family, &CurveFamilyTraits::family);
}

std::string formula_words(CurveFamily family, bool log_axis) {
  std::string words(traits_of(family).formula);
  if (const auto hole = words.find("{}"); hole != std::string::npos) {
    words.replace(hole, 2, log_axis ? "ln x" : "x");
  }
  return words;
}

PsychometricLevels levels_of(const std::vector<AnswerCount>& rows, const CurveModel& model) {
  core::require(
      !model.symmetric || (!model.free_guess && !(model.falling && model.guess_rate > 0.0)),
      "symmetric", "a known guess rate, 0 for a curve that falls", model.guess_rate);
  PsychometricEnds ends = {.guess = model.free_guess ? 0.0 : model.guess_rate,
                           .symmetric = model.symmetric,
                           .known_lapse = model.free_lapse ? 0.0 : model.lapse_rate,
                           .free_guess = model.free_guess};
  const PsychometricShape shape = {traits_of(model.family).sigmoid, model.is_logarithmic()};
  if (!model.falling) return pooled_levels(rows, shape, ends);
  if (!model.symmetric) {
    ends = {.guess = model.free_lapse ? 0.0 : model.lapse_rate,
            .symmetric = false,
            .known_lapse = model.free_guess ? 0.0 : model.guess_rate,
            .free_guess = model.free_lapse};
  }
  std::vector<AnswerCount> of_no = rows;
  for (AnswerCount& row : of_no) row.num_yes = row.num_trials - row.num_yes;
  return pooled_levels(of_no, shape, ends);
}

PsychometricLevels binned(const PsychometricLevels& levels, std::size_t most) {
  if (levels.size() <= most) return levels;
  PsychometricLevels result = levels;
  for (auto* column :
       {&result.intensity, &result.abscissa, &result.num_yes, &result.num_trials}) {
    column->clear();
  }
  const double first = levels.abscissa.front();
  const double step = (levels.abscissa.back() - first) / static_cast<double>(most);
  double bin = -1.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double its = std::floor((levels.abscissa[level] - first) / step);
    const double trials = levels.num_trials[level];
    if (its != bin || result.size() == 0) {
      bin = its;
      result.intensity.push_back(levels.intensity[level]);
      // The place is a sum until all levels of the bin are added.
      result.abscissa.push_back(0.0);
      result.num_yes.push_back(0.0);
      result.num_trials.push_back(0.0);
    }
    result.abscissa.back() += trials * levels.abscissa[level];
    result.num_yes.back() += levels.num_yes[level];
    result.num_trials.back() += trials;
  }
  for (std::size_t level = 0; level < result.size(); ++level) {
    result.abscissa[level] /= result.num_trials[level];
  }
  return result;
}

CurveRates rates_of(const CurveModel& model, const PsychometricLevels& levels,
                    const PsychometricCurve& curve) {
  const double at_low = levels.ends.guess + curve.guess;
  if (model.symmetric || !model.falling) return {at_low, curve.lapse};
  return {curve.lapse, at_low};
}

double level_of_proportion(const CurveModel& model, const PsychometricLevels& levels,
                           const PsychometricCurve& curve, double proportion) {
  const double share = model.falling ? 1.0 - proportion : proportion;
  return (share - levels.ends.low(curve.lapse, curve.guess)) /
         levels.ends.rise(curve.lapse, curve.guess);
}

double value_of(const CurveQuantity& quantity, const CurveModel& model,
                const PsychometricLevels& levels, const PsychometricCurve& curve) {
  using Kind = CurveQuantity::Kind;
  switch (quantity.kind) {
    case Kind::kThreshold:
      return intensity_where(levels, curve, quantity.level);
    case Kind::kLocation: {
      const double place =
          (sigmoid_quantile(levels.sigmoid, traits_of(model.family).at_location) -
           curve.offset) /
          curve.slope;
      if (model.family == CurveFamily::kWeibull || !levels.logarithmic()) {
        return levels.intensity_at(place);
      }
      return std::log(levels.origin) + place * levels.unit;
    }
    case Kind::kScale: {
      const double slope = slope_by_axis(levels, curve);
      return model.family == CurveFamily::kWeibull ? slope : 1.0 / slope;
    }
    case Kind::kDistance:
      return std::fabs(intensity_where(levels, curve, quantity.level) -
                       intensity_where(levels, curve, 0.5));
    case Kind::kSlope: {
      const double z = sigmoid_quantile(levels.sigmoid, quantity.level);
      double slope = levels.ends.rise(curve.lapse, curve.guess) *
                     sigmoid_tails(levels.sigmoid, z).density * slope_by_axis(levels, curve);
      if (levels.logarithmic()) slope /= intensity_where(levels, curve, quantity.level);
      return model.falling ? -slope : slope;
    }
    case Kind::kThresholdOfProportion: {
      const double level = level_of_proportion(model, levels, curve, quantity.level);
      if (level <= 0.0) return levels.intensity_at(-core::kInfinity);
      if (level >= 1.0) return levels.intensity_at(core::kInfinity);
      return intensity_where(levels, curve, level);
    }
    case Kind::kSlopeOfProportion: {
      const double level = level_of_proportion(model, levels, curve, quantity.level);
      if (level <= 0.0 || level >= 1.0) return 0.0;
      return value_of({Kind::kSlope, level}, model, levels, curve);
    }
    case Kind::kGuess:
      return rates_of(model, levels, curve).guess;
    case Kind::kLapse:
      return rates_of(model, levels, curve).lapse;
  }
  return std::nan("");
}

}  // namespace jnd::analysis
