#include "analysis/fits/psychometric_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr auto kMaximumLikelihood = PsychometricMethod::kMaximumLikelihood;

/// ln(x / origin), keeping the relative accuracy of a small difference.
double log_ratio(double x, double origin) {
  const double difference = x - origin;
  if (std::fabs(difference) < 0.5 * origin) return std::log1p(difference / origin);
  return std::log(x) - std::log(origin);
}

/// Contribution of one level and its derivatives in z and lapse.
struct LevelCost {
  double value, z, lapse, zz, z_lapse, lapse_lapse;
};

/// k ln f + (n-k) ln(1-f), negated. Without lapses by log tails, which do not underflow.
LevelCost minus_log_likelihood(Sigmoid sigmoid, double yes, double no, double z,
                               double lapse) noexcept {
  const double share = 1.0 - 2.0 * lapse;
  double log_f, log_g, f_z, g_z, f_lapse, g_lapse,
      bend;  // f's derivatives over f, and over 1-f.
  if (lapse == 0.0) {
    const LogSigmoidTails tails = log_sigmoid_tails(sigmoid, z);
    bend = tails.bend;
    log_f = tails.log_lower;
    log_g = tails.log_upper;
    f_z = tails.mills_lower;
    g_z = tails.mills_upper;
    f_lapse = (tails.upper - tails.lower) / tails.lower;
    g_lapse = (tails.upper - tails.lower) / tails.upper;
  } else {
    const SigmoidTails tails = sigmoid_tails(sigmoid, z);
    bend = tails.bend;
    const double f = lapse + share * tails.lower;
    const double g = lapse + share * tails.upper;
    log_f = std::log(f);
    log_g = std::log(g);
    f_z = share * tails.density / f;
    g_z = share * tails.density / g;
    f_lapse = (tails.upper - tails.lower) / f;
    g_lapse = (tails.upper - tails.lower) / g;
  }
  // A zero count contributes nothing, even where its logarithm is infinite.
  LevelCost cost{};
  if (yes > 0.0) {
    cost.value -= yes * log_f;
    cost.z -= yes * f_z;
    cost.lapse -= yes * f_lapse;
    cost.zz += yes * f_z * (f_z - bend);
    cost.z_lapse += yes * f_z * (2.0 / share + f_lapse);
    cost.lapse_lapse += yes * f_lapse * f_lapse;
  }
  if (no > 0.0) {
    cost.value -= no * log_g;
    cost.z += no * g_z;
    cost.lapse += no * g_lapse;
    cost.zz += no * g_z * (g_z + bend);
    cost.z_lapse += no * g_z * (g_lapse - 2.0 / share);
    cost.lapse_lapse += no * g_lapse * g_lapse;
  }
  return cost;
}

LevelCost squared_residual(Sigmoid sigmoid, double proportion, double z,
                           double lapse) noexcept {
  const SigmoidTails tails = sigmoid_tails(sigmoid, z);
  const double share = 1.0 - 2.0 * lapse;
  const double residual = lapse + share * tails.lower - proportion;
  const double f_z = share * tails.density;
  const double f_lapse = tails.upper - tails.lower;
  return {.value = residual * residual,
          .z = 2.0 * residual * f_z,
          .lapse = 2.0 * residual * f_lapse,
          .zz = 2.0 * f_z * (f_z + residual * tails.bend),
          .z_lapse = 2.0 * (f_z * f_lapse - 2.0 * residual * tails.density),
          .lapse_lapse = 2.0 * f_lapse * f_lapse};
}

/// Cost of the level at intensity 0, where f = lapse whatever the slope.
LevelCost cost_at_zero(const PsychometricLevels& levels, PsychometricMethod method,
                       double lapse) noexcept {
  LevelCost cost{};
  if (levels.zero_trials == 0.0) return cost;
  const double no = levels.zero_trials - levels.zero_yes;
  if (method == PsychometricMethod::kLeastSquares) {
    const double residual = lapse - levels.zero_yes / levels.zero_trials;
    return {residual * residual, 0.0, 2.0 * residual, 0.0, 0.0, 2.0};
  }
  if (levels.zero_yes > 0.0) {
    cost.value -= levels.zero_yes * std::log(lapse);
    cost.lapse -= levels.zero_yes / lapse;
    cost.lapse_lapse += levels.zero_yes / (lapse * lapse);
  }
  if (no > 0.0) {
    cost.value -= no * std::log1p(-lapse);
    cost.lapse += no / (1.0 - lapse);
    cost.lapse_lapse += no / ((1.0 - lapse) * (1.0 - lapse));
  }
  return cost;
}

void check(const std::vector<AnswerCount>& data, double reference) {
  core::require_positive(reference, "reference");
  for (const AnswerCount& row : data) {
    core::require_not_negative(row.intensity, "intensity");
    core::require(row.num_trials >= 0, "num_trials", "a number >= 0",
                  static_cast<double>(row.num_trials));
    core::require(row.num_yes >= 0 && row.num_yes <= row.num_trials, "num_yes",
                  "0 to num_trials = " + std::to_string(row.num_trials),
                  static_cast<double>(row.num_yes));
  }
}

}  // namespace

double PsychometricLevels::smallest_gap(bool between_levels) const noexcept {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t level = 0; level < size(); ++level) {
    if (!between_levels) {
      if (abscissa[level] != 0.0) gap = std::min(gap, std::fabs(abscissa[level]));
    } else if (level > 0) {
      gap = std::min(gap, abscissa[level] - abscissa[level - 1]);
    }
  }
  return gap;
}

double PsychometricLevels::intensity_at(double place) const noexcept {
  return logarithmic() ? origin * std::exp(place * unit) : origin + place * unit;
}

double PsychometricLevels::weber_fraction_at(double slope, double pse) const noexcept {
  const double step = sigmoid_jnd(sigmoid) * unit / slope;
  if (logarithmic()) return std::expm1(step);
  return pse > 0.0 ? step / pse : std::numeric_limits<double>::infinity();
}

PsychometricLevels pooled_levels(const std::vector<AnswerCount>& data, double reference,
                                 bool free_pse, PsychometricFamily family) {
  check(data, reference);
  struct Count {
    double num_yes = 0.0, num_trials = 0.0;
  };
  std::map<double, Count> by_intensity;
  const bool logarithmic = traits_of(family).logarithmic;
  PsychometricLevels levels{
      .family = family, .sigmoid = traits_of(family).sigmoid, .reference = reference};
  for (const AnswerCount& row : data) {
    if (row.num_trials == 0) continue;
    if (row.intensity == 0.0 && logarithmic) {
      levels.zero_yes += static_cast<double>(row.num_yes);
      levels.zero_trials += static_cast<double>(row.num_trials);
      continue;
    }
    Count& count = by_intensity[row.intensity];
    count.num_yes += static_cast<double>(row.num_yes);
    count.num_trials += static_cast<double>(row.num_trials);
  }
  levels.origin = reference;
  if (free_pse && !by_intensity.empty()) {
    // A level in the middle, so that nothing cancels however far off the reference is.
    levels.origin =
        std::next(by_intensity.begin(), static_cast<std::ptrdiff_t>(by_intensity.size() / 2))
            ->first;
  }
  double largest = 0.0;
  for (const auto& [intensity, count] : by_intensity) {
    levels.intensity.push_back(intensity);
    levels.abscissa.push_back(logarithmic ? log_ratio(intensity, levels.origin)
                                          : intensity - levels.origin);
    levels.num_yes.push_back(count.num_yes);
    levels.num_trials.push_back(count.num_trials);
    largest = std::max(largest, std::fabs(levels.abscissa.back()));
  }
  if (largest > 0.0) {
    levels.unit = largest;
    for (double& place : levels.abscissa) place /= largest;
  }
  return levels;
}

double PsychometricCurve::weber_fraction(const PsychometricLevels& levels) const noexcept {
  return levels.weber_fraction_at(slope, pse(levels));
}

double PsychometricCurve::pse(const PsychometricLevels& levels) const noexcept {
  return levels.intensity_at(-offset / slope);
}

double PsychometricCurve::probability(const PsychometricLevels& levels,
                                      std::size_t level) const noexcept {
  return lapse +
         (1.0 - 2.0 * lapse) *
             sigmoid_tails(levels.sigmoid, slope * levels.abscissa[level] + offset).lower;
}

PsychometricCost psychometric_cost(const PsychometricLevels& levels, PsychometricMethod method,
                                   const PsychometricCurve& curve) noexcept {
  double value = 0.0, slope = 0.0, offset = 0.0, lapse = 0.0;
  double slope_slope = 0.0, slope_offset = 0.0, offset_offset = 0.0;
  double slope_lapse = 0.0, offset_lapse = 0.0, lapse_lapse = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.abscissa[level];
    const double z = curve.slope * u + curve.offset;
    const double yes = levels.num_yes[level];
    const double trials = levels.num_trials[level];
    const LevelCost cost =
        method == kMaximumLikelihood
            ? minus_log_likelihood(levels.sigmoid, yes, trials - yes, z, curve.lapse)
            : squared_residual(levels.sigmoid, yes / trials, z, curve.lapse);
    value += cost.value;
    slope += cost.z * u;
    offset += cost.z;
    lapse += cost.lapse;
    slope_slope += cost.zz * u * u;
    slope_offset += cost.zz * u;
    offset_offset += cost.zz;
    slope_lapse += cost.z_lapse * u;
    offset_lapse += cost.z_lapse;
    lapse_lapse += cost.lapse_lapse;
  }
  const LevelCost zero = cost_at_zero(levels, method, curve.lapse);
  PsychometricCost total;
  total.value = value + zero.value;
  total.gradient << slope, offset, lapse + zero.lapse;
  total.hessian << slope_slope, slope_offset, slope_lapse,  //
      slope_offset, offset_offset, offset_lapse,            //
      slope_lapse, offset_lapse, lapse_lapse + zero.lapse_lapse;
  return total;
}

Eigen::Matrix3d squared_jacobian(const PsychometricLevels& levels,
                                 const PsychometricCurve& curve) noexcept {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.abscissa[level];
    const SigmoidTails tails = sigmoid_tails(levels.sigmoid, curve.slope * u + curve.offset);
    const double f_z = (1.0 - 2.0 * curve.lapse) * tails.density;
    const Eigen::Vector3d row(f_z * u, f_z, tails.upper - tails.lower);
    sum += row * row.transpose();
  }
  if (levels.zero_trials > 0.0) sum(2, 2) += 1.0;
  return sum;
}

}  // namespace jnd::analysis
