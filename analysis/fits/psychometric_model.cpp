#include "analysis/fits/psychometric_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/require.h"

namespace jnd::analysis {
namespace {

using enum PsychometricMethod;

/// ln(x / origin). A small difference keeps its relative accuracy.
double log_ratio(double x, double origin) {
  const double difference = x - origin;
  if (std::fabs(difference) < 0.5 * origin) return std::log1p(difference / origin);
  return std::log(x) - std::log(origin);
}

/// The cost of one level and its derivatives by z, the lapse rate and a free guess rate.
struct LevelCost {
  double value, z, lapse, zz, z_lapse, lapse_lapse;
  double guess = 0.0, z_guess = 0.0, lapse_guess = 0.0, guess_guess = 0.0;
};

/// Where the curve underflows, the derivative by a guess rate of 0 is infinite. Any large
/// number can replace it.
constexpr double kLargestShare = 1e100;

/// Minus (k ln f + (n-k) ln(1-f)). Where f falls to 0 or rises to 1 the function uses log
/// tails, which do not underflow.
LevelCost minus_log_likelihood(const PsychometricLevels& levels, double yes, double no,
                               double z, double lapse, double guess) noexcept {
  const PsychometricEnds& ends = levels.ends;
  const double low = ends.low(lapse, guess), rise = ends.rise(lapse, guess);
  const bool from_zero = low == 0.0, to_one = lapse == 0.0;
  double log_f, log_g, f_z, g_z, f_lapse, g_lapse, bend, upper, f, g;
  if (from_zero || to_one) {
    const LogSigmoidTails tails = log_sigmoid_tails(levels.sigmoid, z);
    const double log_rise = std::log(rise), by_lapse = ends.by_lapse(tails.lower, tails.upper);
    bend = tails.bend;
    upper = tails.upper;
    f = low + rise * tails.lower;
    g = lapse + rise * tails.upper;
    log_f = from_zero ? log_rise + tails.log_lower : std::log(f);
    log_g = to_one ? log_rise + tails.log_upper : std::log(g);
    f_z = from_zero ? tails.mills_lower : rise * tails.mills_lower * tails.lower / f;
    g_z = to_one ? tails.mills_upper : rise * tails.mills_upper * tails.upper / g;
    f_lapse = by_lapse / f;
    g_lapse = by_lapse / g;
    // A lapse at the upper end alone scales f.
    if (from_zero && !ends.symmetric) f_lapse = -1.0 / rise;
  } else {
    const SigmoidTails tails = sigmoid_tails(levels.sigmoid, z);
    bend = tails.bend;
    upper = tails.upper;
    f = low + rise * tails.lower;
    g = lapse + rise * tails.upper;
    log_f = std::log(f);
    log_g = std::log(g);
    f_z = rise * tails.density / f;
    g_z = rise * tails.density / g;
    f_lapse = ends.by_lapse(tails.lower, tails.upper) / f;
    g_lapse = ends.by_lapse(tails.lower, tails.upper) / g;
  }
  // A count of 0 contributes nothing, even if its logarithm is infinite.
  const double shrinking = ends.lapse_share() / rise;
  LevelCost cost{};
  if (yes > 0.0) {
    cost.value -= yes * log_f;
    cost.z -= yes * f_z;
    cost.lapse -= yes * f_lapse;
    cost.zz += yes * f_z * (f_z - bend);
    cost.z_lapse += yes * f_z * (shrinking + f_lapse);
    cost.lapse_lapse += yes * f_lapse * f_lapse;
  }
  if (no > 0.0) {
    cost.value -= no * log_g;
    cost.z += no * g_z;
    cost.lapse += no * g_lapse;
    cost.zz += no * g_z * (g_z + bend);
    cost.z_lapse += no * g_z * (g_lapse - shrinking);
    cost.lapse_lapse += no * g_lapse * g_lapse;
  }
  if (!ends.free_guess) return cost;
  // These derivatives are like those by the lapse rate, with df / dguess = 1 - F.
  const double f_guess = std::min(upper / f, kLargestShare);
  const double g_guess = to_one ? 1.0 / rise : upper / g;
  if (yes > 0.0) {
    cost.guess -= yes * f_guess;
    cost.z_guess += yes * f_z * (1.0 / rise + f_guess);
    cost.lapse_guess += yes * f_lapse * f_guess;
    cost.guess_guess += yes * f_guess * f_guess;
  }
  if (no > 0.0) {
    cost.guess += no * g_guess;
    cost.z_guess += no * g_z * (g_guess - 1.0 / rise);
    cost.lapse_guess += no * g_lapse * g_guess;
    cost.guess_guess += no * g_guess * g_guess;
  }
  return cost;
}

LevelCost squared_residual(const PsychometricLevels& levels, double proportion, double z,
                           double lapse) noexcept {
  const SigmoidTails tails = sigmoid_tails(levels.sigmoid, z);
  const PsychometricEnds& ends = levels.ends;
  const double rise = ends.rise(lapse);
  const double residual = ends.low(lapse) + rise * tails.lower - proportion;
  const double f_z = rise * tails.density;
  const double f_lapse = ends.by_lapse(tails.lower, tails.upper);
  return {.value = residual * residual,
          .z = 2.0 * residual * f_z,
          .lapse = 2.0 * residual * f_lapse,
          .zz = 2.0 * f_z * (f_z + residual * tails.bend),
          .z_lapse = 2.0 * (f_z * f_lapse - ends.lapse_share() * residual * tails.density),
          .lapse_lapse = 2.0 * f_lapse * f_lapse};
}

/// The cost of the level at intensity 0, where f is at its lower end for every slope.
LevelCost cost_at_zero(const PsychometricLevels& levels, PsychometricMethod method,
                       double lapse, double guess) noexcept {
  LevelCost cost{};
  if (levels.zero_trials == 0.0) return cost;
  const double low = levels.ends.low(lapse, guess), by_lapse = levels.ends.low_by_lapse();
  const double no = levels.zero_trials - levels.zero_yes;
  if (levels.ends.free_guess) {
    if (levels.zero_yes > 0.0) {
      const double share = std::min(1.0 / low, kLargestShare);
      cost.value -= levels.zero_yes * std::log(low);
      cost.guess -= levels.zero_yes * share;
      cost.guess_guess += levels.zero_yes * share * share;
    }
    cost.value -= no * std::log1p(-low);
    cost.guess += no / (1.0 - low);
    cost.guess_guess += no / ((1.0 - low) * (1.0 - low));
    return cost;
  }
  if (method == PsychometricMethod::kLeastSquares) {
    const double residual = low - levels.zero_yes / levels.zero_trials;
    return {residual * residual, 0.0, 2.0 * residual * by_lapse, 0.0, 0.0, 2.0 * by_lapse};
  }
  if (levels.zero_yes > 0.0) cost.value -= levels.zero_yes * std::log(low);
  if (no > 0.0) cost.value -= no * std::log1p(-low);
  if (by_lapse == 0.0) return cost;
  if (levels.zero_yes > 0.0) {
    cost.lapse -= levels.zero_yes / low;
    cost.lapse_lapse += levels.zero_yes / (low * low);
  }
  if (no > 0.0) {
    cost.lapse += no / (1.0 - low);
    cost.lapse_lapse += no / ((1.0 - low) * (1.0 - low));
  }
  return cost;
}

void check(const std::vector<AnswerCount>& data, bool signed_intensities) {
  for (const AnswerCount& row : data) {
    if (signed_intensities) {
      core::require(std::isfinite(row.intensity), "intensity", "a finite number",
                    row.intensity);
    } else {
      core::require_not_negative(row.intensity, "intensity");
    }
    core::require(row.num_trials >= 0, "num_trials", "a number >= 0",
                  static_cast<double>(row.num_trials));
    core::require(row.num_yes >= 0 && row.num_yes <= row.num_trials, "num_yes",
                  "0 to num_trials = " + std::to_string(row.num_trials),
                  static_cast<double>(row.num_yes));
  }
}

struct Pooling {
  double reference = 1.0;
  bool free_pse = true, signed_intensities = false;
};

PsychometricLevels pooled(const std::vector<AnswerCount>& data, const PsychometricShape& shape,
                          const PsychometricEnds& ends, const Pooling& how) {
  check(data, how.signed_intensities);
  core::require(ends.guess >= 0.0 && ends.guess < 1.0, "guess_rate", "a number in [0, 1)",
                ends.guess);
  core::require(
      ends.known_lapse >= 0.0 &&
          (ends.free_guess ? ends.known_lapse < 1.0 : ends.known_lapse < ends.lapse_limit()),
      "lapse_rate", "a number >= 0 that leaves the curve a rise", ends.known_lapse);
  core::require(!ends.free_guess || !ends.symmetric, "guess_rate",
                "one that is known where lapses are at both ends", 0.0);
  struct Count {
    double intensity = 0.0, num_yes = 0.0, num_trials = 0.0;
  };
  std::vector<Count> counts;
  PsychometricLevels levels{.sigmoid = shape.sigmoid,
                            .is_logarithmic = shape.logarithmic,
                            .ends = ends,
                            .reference = how.reference};
  for (const AnswerCount& row : data) {
    if (row.num_trials == 0) continue;
    if (row.intensity == 0.0 && shape.logarithmic) {
      levels.zero_yes += static_cast<double>(row.num_yes);
      levels.zero_trials += static_cast<double>(row.num_trials);
      continue;
    }
    counts.push_back(
        {row.intensity, static_cast<double>(row.num_yes), static_cast<double>(row.num_trials)});
  }
  std::ranges::sort(counts, {}, &Count::intensity);
  std::size_t num_levels = 0;
  for (const Count& count : counts) {
    if (num_levels > 0 && counts[num_levels - 1].intensity == count.intensity) {
      counts[num_levels - 1].num_yes += count.num_yes;
      counts[num_levels - 1].num_trials += count.num_trials;
    } else {
      counts[num_levels++] = count;
    }
  }
  counts.resize(num_levels);
  levels.origin = how.reference;
  // The origin is a level in the middle, so that nothing cancels however far away the reference
  // is.
  if (how.free_pse && num_levels > 0) levels.origin = counts[num_levels / 2].intensity;
  double largest = 0.0;
  for (const Count& count : counts) {
    levels.intensity.push_back(count.intensity);
    levels.abscissa.push_back(shape.logarithmic ? log_ratio(count.intensity, levels.origin)
                                                : count.intensity - levels.origin);
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
                                 bool free_pse, PsychometricFamily family,
                                 const PsychometricEnds& ends) {
  core::require_positive(reference, "reference");
  const PsychometricFamilyTraits& traits = traits_of(family);
  return pooled(data, {traits.sigmoid, traits.logarithmic}, ends,
                {.reference = reference, .free_pse = free_pse, .signed_intensities = false});
}

PsychometricLevels pooled_levels(const std::vector<AnswerCount>& data,
                                 const PsychometricShape& shape, const PsychometricEnds& ends) {
  return pooled(data, shape, ends,
                {.reference = 1.0, .free_pse = true, .signed_intensities = !shape.logarithmic});
}

PsychometricLevels levels_by_row(const std::vector<AnswerCount>& data,
                                 const PsychometricLevels& pooled) {
  struct Entry {
    std::size_t level = 0;
    double num_yes = 0.0, num_trials = 0.0;
  };
  std::vector<Entry> single(pooled.size()), entries;
  for (const AnswerCount& row : data) {
    if (row.num_trials == 0 || (row.intensity == 0.0 && pooled.logarithmic())) continue;
    const auto found = std::ranges::lower_bound(pooled.intensity, row.intensity);
    const auto level = static_cast<std::size_t>(found - pooled.intensity.begin());
    if (row.num_trials > 1) {
      entries.push_back(
          {level, static_cast<double>(row.num_yes), static_cast<double>(row.num_trials)});
      continue;
    }
    single[level].num_yes += static_cast<double>(row.num_yes);
    single[level].num_trials += 1.0;
  }
  for (std::size_t level = 0; level < single.size(); ++level) {
    if (single[level].num_trials == 0.0) continue;
    entries.push_back({level, single[level].num_yes, single[level].num_trials});
  }
  std::ranges::stable_sort(entries, {}, &Entry::level);
  PsychometricLevels by_row = pooled;
  by_row.intensity.clear();
  by_row.abscissa.clear();
  by_row.num_yes.clear();
  by_row.num_trials.clear();
  for (const Entry& entry : entries) {
    by_row.intensity.push_back(pooled.intensity[entry.level]);
    by_row.abscissa.push_back(pooled.abscissa[entry.level]);
    by_row.num_yes.push_back(entry.num_yes);
    by_row.num_trials.push_back(entry.num_trials);
  }
  return by_row;
}

double PsychometricCurve::weber_fraction(const PsychometricLevels& levels) const noexcept {
  return levels.weber_fraction_at(slope, pse(levels));
}

double PsychometricCurve::pse(const PsychometricLevels& levels) const noexcept {
  return levels.intensity_at(-offset / slope);
}

double PsychometricCurve::probability(const PsychometricLevels& levels,
                                      std::size_t level) const noexcept {
  return levels.ends.low(lapse, guess) +
         levels.ends.rise(lapse, guess) *
             sigmoid_tails(levels.sigmoid, slope * levels.abscissa[level] + offset).lower;
}

PsychometricCost psychometric_cost(const PsychometricLevels& levels, PsychometricMethod method,
                                   const PsychometricCurve& curve) noexcept {
  double value = 0.0, slope = 0.0, offset = 0.0, lapse = 0.0, guess = 0.0;
  double slope_slope = 0.0, slope_offset = 0.0, offset_offset = 0.0;
  double slope_lapse = 0.0, offset_lapse = 0.0, lapse_lapse = 0.0;
  double slope_guess = 0.0, offset_guess = 0.0, lapse_guess = 0.0, guess_guess = 0.0;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.abscissa[level];
    const double z = curve.slope * u + curve.offset;
    const double yes = levels.num_yes[level];
    const double trials = levels.num_trials[level];
    const LevelCost cost =
        method == kMaximumLikelihood
            ? minus_log_likelihood(levels, yes, trials - yes, z, curve.lapse, curve.guess)
            : squared_residual(levels, yes / trials, z, curve.lapse);
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
    if (!levels.ends.free_guess) continue;
    guess += cost.guess;
    slope_guess += cost.z_guess * u;
    offset_guess += cost.z_guess;
    lapse_guess += cost.lapse_guess;
    guess_guess += cost.guess_guess;
  }
  const LevelCost zero = cost_at_zero(levels, method, curve.lapse, curve.guess);
  PsychometricCost total;
  total.value = value + zero.value;
  total.gradient << slope, offset, lapse + zero.lapse, guess + zero.guess;
  total.hessian << slope_slope, slope_offset, slope_lapse, slope_guess,  //
      slope_offset, offset_offset, offset_lapse, offset_guess,           //
      slope_lapse, offset_lapse, lapse_lapse + zero.lapse_lapse, lapse_guess, slope_guess,
      offset_guess, lapse_guess, guess_guess + zero.guess_guess;
  return total;
}

Eigen::Matrix3d squared_jacobian(const PsychometricLevels& levels,
                                 const PsychometricCurve& curve) noexcept {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double u = levels.abscissa[level];
    const SigmoidTails tails = sigmoid_tails(levels.sigmoid, curve.slope * u + curve.offset);
    const double f_z = levels.ends.rise(curve.lapse) * tails.density;
    const Eigen::Vector3d row(f_z * u, f_z, levels.ends.by_lapse(tails.lower, tails.upper));
    sum += row * row.transpose();
  }
  if (levels.zero_trials > 0.0 && levels.ends.symmetric) sum(2, 2) += 1.0;
  return sum;
}

}  // namespace jnd::analysis
