#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/mixed/mixed_model.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// A random term over the rows: `(names | group)`.
struct MixedTerm {
  std::string group;
  std::vector<std::string> names;    ///< The names of the columns of z.
  Eigen::MatrixXd z;                 ///< Rows x effects.
  std::vector<std::uint32_t> place;  ///< The group of each row, counted from 0.
  std::size_t num_groups = 0;
};

/// Answers, with the numbers that a formula makes of the table.
struct MixedData {
  std::vector<std::string> names;  ///< The names of the columns of x.
  Eigen::MatrixXd x;               ///< Rows x fixed effects.
  std::vector<double> num_yes, num_trials;
  /// There is at least one term. Terms with the same `group` have the same `place`.
  std::vector<MixedTerm> terms;
};

struct MixedOptions {
  MixedCurve curve;
  /// The number of nodes in each dimension, 1 to 61. 1 is Laplace's approximation.
  int num_nodes = 1;
};

struct FixedEffect {
  std::string name;
  double estimate = 0.0;
  double standard_error = 0.0;
  double z = 0.0;
  double p = 0.0;  ///< Two-sided, from the normal distribution.
};

struct RandomEffect {
  std::string group, name;
  double sd = 0.0;
  /// The correlations with the preceding effects of the same term, in their order.
  std::vector<double> correlations;
};

struct MixedFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no fit; "" if there is one.
  std::vector<FixedEffect> fixed;
  std::vector<RandomEffect> random;
  Eigen::MatrixXd fixed_covariance;
  double log_likelihood = 0.0;
  double aic = 0.0, bic = 0.0;  ///< BIC counts each row as one observation.
  int num_parameters = 0;
  std::size_t num_rows = 0;
  std::vector<std::string> notes;

  [[nodiscard]] Eigen::VectorXd estimates() const;
};

/// Fits the mixed model by maximum likelihood. Standard errors come from the observed
/// information of fixed effects and theta together. Throws `core::Error` in one sentence if a
/// column of x is a linear combination of others or if a grouping has only one group, and for
/// what `MixedLikelihood` rejects. Not real time.
[[nodiscard]] MixedFit fit_mixed(const MixedData& data, const MixedOptions& options = {});

/// A fit that a bootstrap can repeat: fits of redrawn answers start from it.
class MixedRefit {
 public:
  MixedRefit(const MixedData& data, const MixedOptions& options);
  [[nodiscard]] const MixedFit& fit() const noexcept { return fit_; }

  /// Redraws random effects and answers from the fit, and returns the fixed effects of a new
  /// fit. The vector is empty if the redrawn answers have no fit. The same (seed, index) gives
  /// the same result. It may be called from any thread.
  [[nodiscard]] Eigen::VectorXd redrawn(std::uint64_t seed, std::int64_t index) const;

 private:
  friend MixedFit fit_mixed(const MixedData& data, const MixedOptions& options);

  /// Where a term of the data stands in the model.
  struct TermPlace {
    std::size_t grouping = 0;
    Eigen::Index first_theta = 0;  ///< The index among all parameters.
    /// The requested effects are `scale` times those of the model.
    Eigen::MatrixXd scale;
  };

  void build_model(const MixedData& data);
  void spread_at_least(double loading, Eigen::VectorXd& parameters) const;
  void tell_effects(const MixedData& data, const Eigen::VectorXd& parameters,
                    const Eigen::MatrixXd& covariance);

  MixedOptions options_;
  MixedModel model_;  ///< Its columns are uncorrelated and have mean square 1.
  /// The requested fixed effects are this matrix times those of the model.
  Eigen::MatrixXd fixed_scale_;
  std::vector<TermPlace> places_;
  Eigen::VectorXd parameters_;
  Eigen::MatrixXd covariance_;
  MixedFit fit_;
};

}  // namespace jnd::analysis
