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
  std::vector<std::string> names;    ///< Of the columns of z.
  Eigen::MatrixXd z;                 ///< Rows x effects.
  std::vector<std::uint32_t> place;  ///< Group of each row, from 0.
  std::size_t num_groups = 0;
};

/// Answers with the numbers that a formula makes of them.
struct MixedData {
  std::vector<std::string> names;  ///< Of the columns of x.
  Eigen::MatrixXd x;               ///< Rows x fixed effects.
  std::vector<double> num_yes, num_trials;
  std::vector<MixedTerm> terms;  ///< At least one; those of one `group` share its places.
};

struct MixedOptions {
  MixedCurve curve;
  int num_nodes = 1;  ///< 1 to 61 a dimension; 1 is Laplace's approximation.
};

struct FixedEffect {
  std::string name;
  double estimate = 0.0;
  double standard_error = 0.0;
  double z = 0.0;
  double p = 0.0;  ///< Two-sided, of the normal distribution.
};

struct RandomEffect {
  std::string group, name;
  double sd = 0.0;
  std::vector<double> correlations;  ///< With those of its term before it, in their order.
};

struct MixedFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< "" where there is a fit.
  std::vector<FixedEffect> fixed;
  std::vector<RandomEffect> random;
  Eigen::MatrixXd fixed_covariance;
  double log_likelihood = 0.0;
  double aic = 0.0, bic = 0.0;  ///< With as many observations as rows.
  int num_parameters = 0;
  std::size_t num_rows = 0;
  std::vector<std::string> notes;

  [[nodiscard]] Eigen::VectorXd estimates() const;
};

/// Maximum likelihood of the mixed model of these data; standard errors are of the observed
/// information of fixed effects and theta together. Throws `core::Error`, one sentence, where a
/// column of x is a sum of others, where a grouping has one group alone, and as
/// `MixedLikelihood` does. Not real time.
[[nodiscard]] MixedFit fit_mixed(const MixedData& data, const MixedOptions& options = {});

/// The fit with what a bootstrap needs of it: fits of answers drawn anew start from it.
class MixedRefit {
 public:
  MixedRefit(const MixedData& data, const MixedOptions& options);
  [[nodiscard]] const MixedFit& fit() const noexcept { return fit_; }

  /// Fixed effects fitted to answers drawn from the fit, random effects anew among them; empty
  /// where those have no fit. The same (seed, index) gives the same. From any thread.
  [[nodiscard]] Eigen::VectorXd redrawn(std::uint64_t seed, std::int64_t index) const;

 private:
  friend MixedFit fit_mixed(const MixedData& data, const MixedOptions& options);

  /// Where a term of the data is in the model.
  struct TermPlace {
    std::size_t grouping = 0;
    Eigen::Index first_theta = 0;  ///< Among all parameters.
    Eigen::MatrixXd scale;         ///< Effects as asked for = scale times those of the model.
  };

  void build_model(const MixedData& data);
  void spread_at_least(double loading, Eigen::VectorXd& parameters) const;
  void tell_effects(const MixedData& data, const Eigen::VectorXd& parameters,
                    const Eigen::MatrixXd& covariance);

  MixedOptions options_;
  MixedModel model_;             ///< Columns without correlation and of mean square 1.
  Eigen::MatrixXd fixed_scale_;  ///< Fixed effects as asked for = this times the model's.
  std::vector<TermPlace> places_;
  Eigen::VectorXd parameters_;
  Eigen::MatrixXd covariance_;
  MixedFit fit_;
};

}  // namespace jnd::analysis
