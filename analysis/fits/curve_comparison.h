#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/fits/likelihood_profile.h"

namespace jnd::analysis {

/// The curves of several groups of answers on one abscissa, which may share some of their
/// parameters. Each group has these parameters: the place of its location on the abscissa, ln
/// slope, and an angle a for each free rate, where rate = limit sin^2 a.
class JointCurves {
 public:
  /// Which of location, scale and rates all groups have in common.
  struct Shared {
    bool location = false, scale = false, rates = false;
  };

  JointCurves(const std::vector<FoundCurve>& groups, const CurveModel& model);

  [[nodiscard]] std::size_t num_groups() const noexcept { return levels_.size(); }
  [[nodiscard]] const PsychometricLevels& levels(std::size_t group) const {
    return levels_[group];
  }
  [[nodiscard]] int num_parameters(const Shared& shared) const;
  /// The optimum over all groups under the given sharing of parameters.
  [[nodiscard]] LikelihoodOptimum optimum(const Shared& shared) const;
  /// A group's parameters as its own fit found them.
  [[nodiscard]] const std::vector<double>& found(std::size_t group) const {
    return found_[group];
  }
  [[nodiscard]] double found_cost(std::size_t group) const { return found_cost_[group]; }

  /// Computes minus the log-likelihood of a group's answers, and its gradient in the group's
  /// parameters. Returns false where the parameters have left the range of numbers. `level` is
  /// the value of F at the location.
  bool cost(std::size_t group, double level, std::span<const double> x, double& value,
            std::span<double> gradient) const;
  /// The group's parameters, with the place where F is `level` in the position of the location.
  [[nodiscard]] std::vector<double> at_level(std::size_t group, double level) const;
  [[nodiscard]] double location_level() const noexcept { return location_level_; }
  [[nodiscard]] std::size_t size_of_group() const noexcept {
    return 2 + (free_[2] ? 1U : 0U) + (free_[3] ? 1U : 0U);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> places_of(const Shared& shared,
                                                   std::size_t group) const;

  double location_level_ = 0.5;
  FreeParameters free_ = {};
  PsychometricCurve known_;  ///< The rates that are not free.
  std::vector<PsychometricLevels> levels_;
  std::vector<std::vector<double>> found_;
  std::vector<double> found_cost_;
};

/// One way in which the groups may share parameters, and how well it fits.
struct ComparedModel {
  std::string name;  ///< For example "different location, same scale".
  JointCurves::Shared shared;
  int num_parameters = 0;
  std::optional<double> log_likelihood, aic, bic;
};

/// Tests whether groups differ in a parameter. It is the likelihood ratio between the model in
/// which all parameters differ and the model in which the groups share this one.
struct ComparisonTest {
  std::string name;  ///< "location", "scale", "rates" or "all".
  double statistic = 0.0;
  int degrees_of_freedom = 0;
  double p_value = 1.0;
};

/// Compares the thresholds of two groups: the second minus the first, and the second divided by
/// the first.
struct CurveContrast {
  std::string one, other;
  double at = 0.5;
  /// The difference, in the unit of the intensities.
  CurveValue difference;
  /// The ratio. It is absent unless both thresholds are > 0.
  CurveValue ratio;
  /// p values of the likelihood-ratio test that both thresholds are equal.
  std::optional<double> p_value, p_value_holm;
};

struct CurveComparison {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  std::vector<ComparedModel> models;
  std::string best_by_aic, best_by_bic;
  std::vector<ComparisonTest> tests;
  std::vector<CurveContrast> contrasts;
};

/// One group of answers.
struct ComparedGroup {
  std::string name;
  std::vector<AnswerCount> rows;
};

/// Compares groups that have the same model. It finds out which parameters they share, and
/// contrasts the thresholds of every pair at the levels of `options`, adjusted by Holm (1979)
/// over the pairs of one level. The status is `degenerate` if a group has no curve or if there
/// are fewer than two groups. With more than 30 groups there are no contrasts. Not real time.
[[nodiscard]] CurveComparison compare_curves(const std::vector<ComparedGroup>& groups,
                                             const CurveOptions& options);

}  // namespace jnd::analysis
