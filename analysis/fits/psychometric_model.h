#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/fits/psychometric_ends.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/sigmoid.h"

namespace jnd::analysis {

/// The shape of a curve: a sigmoid over the intensity or its logarithm.
struct PsychometricShape {
  Sigmoid sigmoid = Sigmoid::kNormal;
  bool logarithmic = true;
};

/// The data of a fit, with one entry for each distinct intensity that has trials, ascending.
/// They are scaled, so the fit does not depend on the unit of the intensities.
struct PsychometricLevels {
  Sigmoid sigmoid = Sigmoid::kNormal;
  bool is_logarithmic = true;
  PsychometricEnds ends;
  double reference = 1.0;
  /// The intensity at abscissa 0: the reference, or a level if the pse is free.
  double origin = 1.0;
  double unit = 1.0;  ///< The largest |ln(x / origin)| or |x - origin|; 1 if that is 0.
  std::vector<double> intensity;  ///< The intensities as they were given.
  std::vector<double> abscissa;   ///< ln(x / origin) / unit, or (x - origin) / unit.
  std::vector<double> num_yes, num_trials;
  /// The answers at intensity 0, which a logarithmic family keeps apart.
  double zero_yes = 0.0, zero_trials = 0.0;

  [[nodiscard]] std::size_t size() const noexcept { return abscissa.size(); }
  [[nodiscard]] double proportion(std::size_t level) const noexcept {
    return num_yes[level] / num_trials[level];
  }
  /// The smallest distance that can distinguish two parameters: between levels, or between a
  /// level and the origin.
  [[nodiscard]] double smallest_gap(bool between_levels) const noexcept;
  [[nodiscard]] bool logarithmic() const noexcept { return is_logarithmic; }
  /// The intensity at a place on the abscissa. It may leave the range of numbers.
  [[nodiscard]] double intensity_at(double place) const noexcept;
  /// (x84.13 - pse) / pse of a curve with this slope. On a logarithmic abscissa it does not
  /// depend on the pse. It is infinite if the pse is not > 0.
  [[nodiscard]] double weber_fraction_at(double slope, double pse) const noexcept;
};

/// Pools rows of the same intensity. Throws `core::Error` as `fit_psychometric` does.
[[nodiscard]] PsychometricLevels pooled_levels(
    const std::vector<AnswerCount>& data, double reference, bool free_pse,
    PsychometricFamily family = PsychometricFamily::kWeber, const PsychometricEnds& ends = {});

/// Pools the rows for a curve whose pse is free. On a linear axis intensities may have any
/// sign. Throws `core::Error` for an intensity that is not finite, or that is negative on a
/// logarithmic axis, and for counts and rates as `fit_psychometric` does.
[[nodiscard]] PsychometricLevels pooled_levels(const std::vector<AnswerCount>& data,
                                               const PsychometricShape& shape,
                                               const PsychometricEnds& ends);

/// The same levels on the same abscissa, but with an entry for each row, ascending. Answers of
/// one row may have more in common than answers of two rows, because they come from one person
/// or one session. This cannot be seen in rows of a single answer, so those of one level stay
/// together.
[[nodiscard]] PsychometricLevels levels_by_row(const std::vector<AnswerCount>& data,
                                               const PsychometricLevels& pooled);

/// The curve F(z) between the ends of the levels, with z = slope abscissa + offset.
struct PsychometricCurve {
  double slope = 1.0;   ///< For the Weber curve it is unit / ln(1 + w).
  double offset = 0.0;  ///< -slope times the place of the pse on the abscissa.
  double lapse = 0.0;   ///< The lapse rate, in [0, ends.lapse_limit()).
  double guess = 0.0;   ///< A free guess rate, in [0, ends.guess_limit()); 0 if it is not free.

  [[nodiscard]] double weber_fraction(const PsychometricLevels& levels) const noexcept;
  [[nodiscard]] double pse(const PsychometricLevels& levels) const noexcept;
  /// The probability of yes at a level.
  [[nodiscard]] double probability(const PsychometricLevels& levels,
                                   std::size_t level) const noexcept;
};

/// The cost that is minimised, with its derivatives by (slope, offset, lapse, guess). Those by
/// a guess rate that is not free are 0.
struct PsychometricCost {
  double value = 0.0;  ///< For ml, minus the log-likelihood. For lsq, the sum of squares.
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
};

[[nodiscard]] PsychometricCost psychometric_cost(const PsychometricLevels& levels,
                                                 PsychometricMethod method,
                                                 const PsychometricCurve& curve) noexcept;

/// J^T J of the fitted proportions by (slope, offset, lapse), for a known guess rate.
[[nodiscard]] Eigen::Matrix3d squared_jacobian(const PsychometricLevels& levels,
                                               const PsychometricCurve& curve) noexcept;

}  // namespace jnd::analysis
