#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// The data of a fit, one entry per distinct intensity > 0 with trials, ascending, in scaled
/// logarithms, so that the fit does not know the unit of the intensities.
struct PsychometricLevels {
  double origin = 1.0;  ///< Intensity at log_ratio 0: the reference, or a level if pse is free.
  double unit = 1.0;    ///< What log_ratio is scaled by: its largest |ln(x / origin)|, or 1.
  std::vector<double> log_ratio;  ///< ln(x / origin) / unit, so within [-1, 1].
  std::vector<double> num_yes, num_trials;
  double zero_yes = 0.0, zero_trials = 0.0;  ///< Of the level at intensity 0.

  [[nodiscard]] std::size_t size() const noexcept { return log_ratio.size(); }
  [[nodiscard]] double proportion(std::size_t level) const noexcept {
    return num_yes[level] / num_trials[level];
  }
  /// Smallest distance that tells two things apart: between levels, or from the origin.
  [[nodiscard]] double smallest_gap(bool between_levels) const noexcept;
};

/// Pools the rows. Throws `core::Error` as `fit_psychometric` says.
[[nodiscard]] PsychometricLevels pooled_levels(const std::vector<AnswerCount>& data,
                                               double reference, bool free_pse);

/// The curve, linear in z = slope log_ratio + offset: f = lapse + (1 - 2 lapse) Phi(z).
struct PsychometricCurve {
  double slope = 1.0;   ///< unit / ln(1 + w)
  double offset = 0.0;  ///< -slope ln(pse / origin) / unit
  double lapse = 0.0;   ///< [0, 0.5)

  [[nodiscard]] double weber_fraction(const PsychometricLevels& levels) const noexcept;
  [[nodiscard]] double pse(const PsychometricLevels& levels) const noexcept;
  /// Probability of yes at a level.
  [[nodiscard]] double probability(const PsychometricLevels& levels,
                                   std::size_t level) const noexcept;
};

/// What is minimised, with its derivatives in (slope, offset, lapse).
struct PsychometricCost {
  double value = 0.0;  ///< ml: minus the log-likelihood. lsq: the sum of squares.
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
};

[[nodiscard]] PsychometricCost psychometric_cost(const PsychometricLevels& levels,
                                                 PsychometricMethod method,
                                                 const PsychometricCurve& curve) noexcept;

/// J^T J of the fitted proportions in (slope, offset, lapse).
[[nodiscard]] Eigen::Matrix3d squared_jacobian(const PsychometricLevels& levels,
                                               const PsychometricCurve& curve) noexcept;

}  // namespace jnd::analysis
