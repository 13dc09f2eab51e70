#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/fits/likelihood_profile.h"

namespace jnd::analysis {

/// Curves of several groups of answers, on one abscissa, some of whose parameters are the same.
/// The parameters of a group are the place of its location on the abscissa, ln slope, and
/// angles a of the rates that are free: rate = limit sin^2 a.
class JointCurves {
 public:
  /// Which of location, scale and rates all groups share.
  struct Shared {
    bool location = false, scale = false, rates = false;
  };

  JointCurves(const std::vector<FoundCurve>& groups, const CurveModel& model);

  [[nodiscard]] std::size_t num_groups() const noexcept { return levels_.size(); }
  [[nodiscard]] const PsychometricLevels& levels(std::size_t group) const {
    return levels_[group];
  }
  [[nodiscard]] int num_parameters(const Shared& shared) const;
  /// Of all groups, where the parameters that are shared are at their best.
  [[nodiscard]] LikelihoodOptimum optimum(const Shared& shared) const;
  /// A group's own parameters, as its fit found them.
  [[nodiscard]] const std::vector<double>& found(std::size_t group) const {
    return found_[group];
  }
  [[nodiscard]] double found_cost(std::size_t group) const { return found_cost_[group]; }

  /// Minus the log-likelihood of a group's answers and its gradient in the group's parameters;
  /// false where they have left the range of numbers. `level` is what F is at the location.
  bool cost(std::size_t group, double level, std::span<const double> x, double& value,
            std::span<double> gradient) const;
  /// The group's parameters with the place where F is `level` for that of the location.
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

/// One way in which groups may share parameters.
struct ComparedModel {
  std::string name;  ///< "different location, same scale"
  JointCurves::Shared shared;
  int num_parameters = 0;
  std::optional<double> log_likelihood, aic, bic;
};

/// Whether groups differ in a parameter: the likelihood ratio of the model in which all differ
/// and the one in which this is the same.
struct ComparisonTest {
  std::string name;  ///< "location", "scale", "rates", "all"
  double statistic = 0.0;
  int degrees_of_freedom = 0;
  double p_value = 1.0;
};

/// Two groups' thresholds compared, the second less the first and over it.
struct CurveContrast {
  std::string one, other;
  double at = 0.5;
  CurveValue difference;                        ///< In the unit of the intensities.
  CurveValue ratio;                             ///< Absent unless both thresholds are > 0.
  std::optional<double> p_value, p_value_holm;  ///< Likelihood ratio, of equal thresholds.
};

struct CurveComparison {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;
  std::vector<ComparedModel> models;
  std::string best_by_aic, best_by_bic;
  std::vector<ComparisonTest> tests;
  std::vector<CurveContrast> contrasts;
};

/// One group of answers and its fit.
struct ComparedGroup {
  std::string name;
  std::vector<AnswerCount> rows;
};

/// Compares groups that have the same model: which parameters they share, and the thresholds of
/// every two of them at the levels of `options`, adjusted by Holm (1979) over the pairs of a
/// level. `degenerate` where a group has no curve, or there are fewer than two. At most 30
/// groups have contrasts. Not real time.
[[nodiscard]] CurveComparison compare_curves(const std::vector<ComparedGroup>& groups,
                                             const CurveOptions& options);

}  // namespace jnd::analysis
