#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/mixed/mixed_link.h"

namespace jnd::analysis {

/// Matrices of which rows are read one after the other.
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Groups that differ, and in what. Several random terms with the same groups are one grouping.
struct MixedGrouping {
  std::string name;
  RowMatrix z;                       ///< Rows x effects.
  std::vector<std::uint32_t> group;  ///< Of each row, from 0.
  std::size_t num_groups = 0;
  /// Effects one after another that correlate freely; those of different terms do not.
  std::vector<int> term_sizes;

  [[nodiscard]] int num_effects() const noexcept { return static_cast<int>(z.cols()); }
  [[nodiscard]] int num_parameters() const noexcept;
};

/// A generalised linear mixed model of counts: yes_i of trials_i answers, P(yes) =
/// curve(eta_i),
///
///     eta = X beta + sum over groupings of Z_k Lambda_k u_k,   u normal(0, I),
///
/// Lambda_k being the same lower triangular matrix for each group, block by block a term.
struct MixedModel {
  MixedCurve curve;
  RowMatrix x;  ///< Rows x fixed effects.
  std::vector<double> num_yes, num_trials;
  /// Sum of ln C(trials, yes) over the rows as they came, which rows of trials have none of.
  double log_coefficients = 0.0;
  /// One or more; fastest with the one first that has the most groups times effects.
  std::vector<MixedGrouping> groupings;

  [[nodiscard]] std::size_t num_rows() const noexcept { return num_yes.size(); }
  [[nodiscard]] int num_fixed() const noexcept { return static_cast<int>(x.cols()); }
  /// Fixed effects, then theta: the entries of each term's Lambda column by column from the
  /// diagonal down, as in lme4.
  [[nodiscard]] int num_parameters() const noexcept;
};

/// Sum of ln C(trials, yes).
[[nodiscard]] double log_coefficients_of(const std::vector<double>& num_yes,
                                         const std::vector<double>& num_trials);

/// The same model with rows of one group and the same numbers added up, sorted by the groups
/// of the first grouping. The likelihood is the same.
[[nodiscard]] MixedModel collapsed(const MixedModel& model);

/// Lambda of one group from the theta of its grouping.
[[nodiscard]] Eigen::MatrixXd loadings_of(const MixedGrouping& grouping, const double* theta);

}  // namespace jnd::analysis
