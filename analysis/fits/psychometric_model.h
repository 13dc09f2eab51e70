#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/fits/psychometric_ends.h"
#include "analysis/fits/psychometric_fit.h"
#include "analysis/fits/sigmoid.h"

namespace jnd::analysis {

/// What a curve is of: a shape, over the intensity or its logarithm.
struct PsychometricShape {
  Sigmoid sigmoid = Sigmoid::kNormal;
  bool logarithmic = true;
};

/// The data of a fit, one entry per distinct intensity with trials, ascending, scaled, so that
/// the fit does not know the unit of the intensities.
struct PsychometricLevels {
  Sigmoid sigmoid = Sigmoid::kNormal;
  bool is_logarithmic = true;
  PsychometricEnds ends;
  double reference = 1.0;
  double origin = 1.0;  ///< Intensity at abscissa 0: the reference, or a level if pse is free.
  double unit = 1.0;    ///< Largest |ln(x / origin)|, or |x - origin|; 1 if that is 0.
  std::vector<double> intensity;  ///< The intensity that was given.
  std::vector<double> abscissa;   ///< ln(x / origin) / unit, or (x - origin) / unit.
  std::vector<double> num_yes, num_trials;
  /// Of the level at intensity 0, which a logarithmic family keeps apart.
  double zero_yes = 0.0, zero_trials = 0.0;

  [[nodiscard]] std::size_t size() const noexcept { return abscissa.size(); }
  [[nodiscard]] double proportion(std::size_t level) const noexcept {
    return num_yes[level] / num_trials[level];
  }
  /// Smallest distance that tells two things apart: between levels, or from the origin.
  [[nodiscard]] double smallest_gap(bool between_levels) const noexcept;
  [[nodiscard]] bool logarithmic() const noexcept { return is_logarithmic; }
  /// Intensity at a place on the abscissa, which may leave the range of numbers.
  [[nodiscard]] double intensity_at(double place) const noexcept;
  /// (x84.13 - pse) / pse of a curve of this slope, which on a logarithmic abscissa is the same
  /// at every pse. Infinite for a pse that is not > 0.
  [[nodiscard]] double weber_fraction_at(double slope, double pse) const noexcept;
};

/// Pools the rows. Throws `core::Error` as `fit_psychometric` says.
[[nodiscard]] PsychometricLevels pooled_levels(
    const std::vector<AnswerCount>& data, double reference, bool free_pse,
    PsychometricFamily family = PsychometricFamily::kWeber, const PsychometricEnds& ends = {});

/// Pools the rows for a curve whose pse is free, over intensities of any sign where the axis is
/// linear. Throws `core::Error` for an intensity that is not finite, or negative on a
/// logarithmic axis, and for counts and rates as `fit_psychometric`.
[[nodiscard]] PsychometricLevels pooled_levels(const std::vector<AnswerCount>& data,
                                               const PsychometricShape& shape,
                                               const PsychometricEnds& ends);

/// The same levels on the same abscissa, but every row an entry of its own, ascending: answers
/// of one row may have more in common than those of two, such as a person or a session. Rows of
/// a single answer have nothing in common with themselves, so those of one level stay together.
[[nodiscard]] PsychometricLevels levels_by_row(const std::vector<AnswerCount>& data,
                                               const PsychometricLevels& pooled);

/// The curve, linear in z = slope abscissa + offset: between the ends of the levels, F(z).
struct PsychometricCurve {
  double slope = 1.0;   ///< unit / ln(1 + w) of the Weber curve
  double offset = 0.0;  ///< -slope times the pse's place on the abscissa
  double lapse = 0.0;   ///< [0, ends.lapse_limit())
  double guess = 0.0;   ///< Where it is free: [0, ends.guess_limit()); else 0.

  [[nodiscard]] double weber_fraction(const PsychometricLevels& levels) const noexcept;
  [[nodiscard]] double pse(const PsychometricLevels& levels) const noexcept;
  /// Probability of yes at a level.
  [[nodiscard]] double probability(const PsychometricLevels& levels,
                                   std::size_t level) const noexcept;
};

/// What is minimised, with its derivatives in (slope, offset, lapse, guess); those in a guess
/// rate that is not free are 0.
struct PsychometricCost {
  double value = 0.0;  ///< ml: minus the log-likelihood. lsq: the sum of squares.
  Eigen::Vector4d gradient = Eigen::Vector4d::Zero();
  Eigen::Matrix4d hessian = Eigen::Matrix4d::Zero();
};

[[nodiscard]] PsychometricCost psychometric_cost(const PsychometricLevels& levels,
                                                 PsychometricMethod method,
                                                 const PsychometricCurve& curve) noexcept;

/// J^T J of the fitted proportions in (slope, offset, lapse), the guess rate being known.
[[nodiscard]] Eigen::Matrix3d squared_jacobian(const PsychometricLevels& levels,
                                               const PsychometricCurve& curve) noexcept;

}  // namespace jnd::analysis
