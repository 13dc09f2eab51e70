#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/mixed/mixed_link.h"

namespace jnd::analysis {

/// A matrix that is read row by row.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Groups that differ, and the effects in which they differ. Several random terms with the same
/// groups form one grouping.
struct MixedGrouping {
  std::string name;
  RowMatrix z;                       ///< Rows x effects.
  std::vector<std::uint32_t> group;  ///< The group of each row, counted from 0.
  std::size_t num_groups = 0;
  /// The sizes of the terms. Effects of one term stand together and correlate freely. Effects
  /// of different terms are uncorrelated.
  std::vector<int> term_sizes;

  [[nodiscard]] int num_effects() const noexcept { return static_cast<int>(z.cols()); }
  [[nodiscard]] int num_parameters() const noexcept;
};

/// A generalised linear mixed model of counts: yes_i of trials_i answers, with P(yes) =
/// curve(eta_i) and
///
///     eta = X beta + sum over groupings of Z_k Lambda_k u_k,   u normal(0, I).
///
/// Lambda_k is the same lower triangular matrix for every group, with one block for each term.
struct MixedModel {
  MixedCurve curve;
  RowMatrix x;  ///< Rows x fixed effects.
  std::vector<double> num_yes, num_trials;
  /// The sum of ln C(trials, yes) over the original rows. Rows of single trials add nothing.
  double log_coefficients = 0.0;
  /// At least one grouping. The search is fastest if the first has the most groups times
  /// effects.
  std::vector<MixedGrouping> groupings;

  [[nodiscard]] std::size_t num_rows() const noexcept { return num_yes.size(); }
  [[nodiscard]] int num_fixed() const noexcept { return static_cast<int>(x.cols()); }
  /// The number of parameters. They are the fixed effects, then theta: the entries of each
  /// term's Lambda, column by column from the diagonal down, as in lme4.
  [[nodiscard]] int num_parameters() const noexcept;
};

/// The sum of ln C(trials, yes).
[[nodiscard]] double log_coefficients_of(const std::vector<double>& num_yes,
                                         const std::vector<double>& num_trials);

/// The same model with equal rows of the same groups pooled, sorted by the groups of the first
/// grouping. The likelihood is the same.
[[nodiscard]] MixedModel collapsed(const MixedModel& model);

/// Lambda of one group, from its grouping's theta.
[[nodiscard]] Eigen::MatrixXd loadings_of(const MixedGrouping& grouping, const double* theta);

}  // namespace jnd::analysis
