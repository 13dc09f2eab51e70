#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/mixed/design.h"
#include "analysis/mixed/mixed_link.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// How eta depends on the stimulus.
enum class StimulusAxis {
  kLinear,       ///< eta = a + b x
  kLogarithmic,  ///< eta = a + b ln x
};

/// A combination of the factors' levels, with the line of eta over the stimulus in it.
struct MixedCell {
  std::string name;  ///< For example "condition A, block 2"; "" without factors.
  /// The level of each factor, in the order of the formula's variables.
  std::vector<double> levels;
  Eigen::VectorXd offset;  ///< a = offset' beta
  Eigen::VectorXd slope;   ///< b = slope' beta
};

/// The cells that occur in the rows, and how eta depends on the stimulus.
struct StimulusLines {
  StimulusAxis axis = StimulusAxis::kLinear;
  bool has_weber_fraction = false;  ///< Whether all stimuli are > 0.
  /// In the order of the levels, with the last factor varying fastest.
  std::vector<MixedCell> cells;
  std::vector<std::string> held;  ///< Other covariates, which are held at their means.
};

/// Finds the lines of eta over the column `stimulus`. Throws `FormulaError` if the formula does
/// not contain it, if it is a factor, or if eta is linear neither in it nor in its logarithm.
/// Not real time.
[[nodiscard]] StimulusLines stimulus_lines(const Formula& formula, const Design& design,
                                           const TrialTable& table,
                                           const std::string& stimulus);

/// A quantity of the median group, whose random effects are 0. q(p) is the quantile of the
/// link, D = q(at) - q(0.5), and t = (q(0.5) - a) / b on either axis:
///
///     PSE             t                  exp(t)
///     JND             |D / b|            exp(t) |exp(D / b) - 1|
///     Weber fraction  JND / PSE          |exp(D / b) - 1|
///                     (linear)           (logarithmic)
///
/// The JND is the distance from the PSE to the stimulus where F is `at`, so that on a
/// logarithmic axis it is shorter where that stimulus lies below the PSE. The Weber fraction
/// exists if all stimuli and the PSE are > 0.
struct DerivedQuantity {
  std::string name;  ///< For example "PSE, condition A" or "JND, condition B - condition A".
  std::optional<double> value;
  std::optional<double> standard_error;  ///< By the delta method.
  /// By the delta method and Student's t. A quantity that is > 0 (a JND, a Weber fraction, a
  /// PSE on a logarithmic axis) has the interval of its logarithm, others that of the value. A
  /// Weber fraction on a logarithmic axis has that of ln |D / b|.
  Interval ci95;
  /// Percentiles of the redraws, expanded for few groups (Hesterberg 2015). A redraw that has
  /// no fit, or in which the quantity does not exist, counts as beyond either end.
  Interval bootstrap_ci95;
};

/// How far the fixed effects may be from the truth.
struct MixedUncertainty {
  Eigen::MatrixXd covariance;
  /// Of the grouping with the fewest groups, >= 2. Student's t has one degree of freedom less.
  std::size_t num_groups = 2;
  /// The fixed effects of bootstrap refits. Those of a redraw without a fit are empty.
  std::vector<Eigen::VectorXd> redrawn;
};

/// Only the values, in the order of `derived_quantities`. Values that do not exist are NaN.
[[nodiscard]] std::vector<double> derived_values(const StimulusLines& lines, MixedLink link,
                                                 double jnd_at, const Eigen::VectorXd& beta);

/// How many redraws the percentiles of a bootstrap need with this number of groups. With fewer
/// than five groups no feasible number is enough.
[[nodiscard]] std::optional<std::size_t> num_redraws_needed(std::size_t num_groups);

/// PSE, JND and Weber fraction of each cell, and then the differences between every two cells
/// that differ in one factor only. `jnd_at` is a level of the curve between guess and lapse
/// rate, and is not 0.5. Not real time.
[[nodiscard]] std::vector<DerivedQuantity> derived_quantities(
    const StimulusLines& lines, MixedLink link, double jnd_at, const Eigen::VectorXd& beta,
    const MixedUncertainty& uncertainty);

}  // namespace jnd::analysis
