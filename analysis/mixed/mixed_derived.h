#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/mixed/design.h"
#include "analysis/mixed/mixed_link.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// What eta depends on the stimulus by.
enum class StimulusAxis {
  kLinear,       ///< eta = a + b x
  kLogarithmic,  ///< eta = a + b ln x
};

/// A combination of the factors' levels, with the line of eta over the stimulus in it.
struct MixedCell {
  std::string name;            ///< "condition A, block 2"; "" without factors.
  std::vector<double> levels;  ///< Of each factor, in the order of the formula's variables.
  Eigen::VectorXd offset;      ///< a = offset' beta
  Eigen::VectorXd slope;       ///< b = slope' beta
};

/// Cells that the rows have, and how the stimulus goes into eta.
struct StimulusLines {
  StimulusAxis axis = StimulusAxis::kLinear;
  bool has_weber_fraction = false;  ///< Whether all stimuli are > 0.
  std::vector<MixedCell> cells;     ///< In the order of the levels, the last factor fastest.
  std::vector<std::string> held;    ///< Other covariates, which are held at their means.
};

/// Where `stimulus` is a column of the formula. Throws `FormulaError` where it is none, is a
/// factor, or goes into eta neither as itself nor as its logarithm. Not real time.
[[nodiscard]] StimulusLines stimulus_lines(const Formula& formula, const Design& design,
                                           const TrialTable& table,
                                           const std::string& stimulus);

/// A quantity of the median group, whose random effects are 0. With q(p) the quantile of the
/// link, D = |q(at) - q(0.5)| and, on either axis, t = (q(0.5) - a) / b:
///
///     PSE             t                  exp(t)
///     JND             D / |b|            exp(t) (exp(D / |b|) - 1)
///     Weber fraction  JND / PSE          exp(D / |b|) - 1
///                     (linear)           (logarithmic)
///
/// The Weber fraction exists where all stimuli and the PSE are > 0.
struct DerivedQuantity {
  std::string name;  ///< "PSE, condition A", "JND, condition B - condition A"
  std::optional<double> value;
  std::optional<double> standard_error;
  Interval ci95;            ///< By the delta method: value +- 1.96 standard errors.
  Interval bootstrap_ci95;  ///< 2.5 % and 97.5 % of the redrawn; where there are any.
};

/// Values alone, in the order of `derived_quantities`; NaN for what does not exist.
[[nodiscard]] std::vector<double> derived_values(const StimulusLines& lines, MixedLink link,
                                                 double jnd_at, const Eigen::VectorXd& beta);

/// PSE, JND and Weber fraction of each cell, then the differences of every two cells that
/// differ in one factor alone. `redrawn`: fixed effects of bootstrap refits. `jnd_at` is a
/// level of the curve between guess and lapse rate, not 0.5. Not real time.
[[nodiscard]] std::vector<DerivedQuantity> derived_quantities(
    const StimulusLines& lines, MixedLink link, double jnd_at, const Eigen::VectorXd& beta,
    const Eigen::MatrixXd& covariance, const std::vector<Eigen::VectorXd>& redrawn);

}  // namespace jnd::analysis
