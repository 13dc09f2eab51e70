#pragma once

#include <map>

#include "analysis/hierarchical/hierarchical_search.h"

namespace jnd::analysis {

/// The log-likelihood over the lapse rate, of own ones the median person's, everything else
/// most likely at each: what answers and prior know of it, and how far it moves the rest. With
/// own lapses the prior moves their spread as well, so that nothing of it is known without.
class LapseProfile {
 public:
  /// Everything else at one lapse rate.
  struct Point {
    bool exists = false;          ///< There is a curve with so many lapses.
    Eigen::VectorXd parameters;   ///< All parameters, the lapse rate's among them.
    double log_likelihood = 0.0;  ///< Log-likelihood of the answers, without the prior.
    double rise = 0.0;            ///< Derivative of the above by the lapse rate; 0 at rate 0.
  };

  /// `found`: the optimum with the prior; `start`: where it was sought from, people differing.
  /// The references have to outlive the profile.
  LapseProfile(const HierarchicalLikelihood& likelihood, const HierarchicalStructure& structure,
               Eigen::VectorXd start, const HierarchicalOptimum& found);

  /// `lapse_rate` in [0, `lapse_limit`).
  const Point& at(double lapse_rate);

  /// Variance of a parameter but the lapse rate's, were that known. Absent where there is no
  /// curve.
  [[nodiscard]] std::optional<double> variance_at(double lapse_rate, int parameter);

  /// The most likely lapse rate by answers and prior.
  [[nodiscard]] double with_prior() const noexcept { return with_prior_; }

  /// The most likely one by the answers alone. Not with own lapses.
  [[nodiscard]] double without_prior();

  /// Where the log-likelihood, the prior's among it or not, has fallen from its largest by half
  /// the 95 % quantile of chi-squared with one degree of freedom. The low end is 0 where it has
  /// not by there; the high end is open where it has not before nine in ten answers are random,
  /// or there is no curve.
  [[nodiscard]] Interval interval(bool has_prior);

 private:
  /// Of the profile at one of its points.
  [[nodiscard]] double height(double lapse_rate, bool has_prior);
  [[nodiscard]] std::optional<double> end(double from, bool has_prior, double direction);
  /// About what the parameters are there, by the points that are known.
  [[nodiscard]] Eigen::VectorXd expected_at(double lapse_rate) const;

  const HierarchicalLikelihood& likelihood_;
  const HierarchicalStructure& structure_;
  HeldSearch search_;
  double with_prior_ = 0.0;
  std::optional<double> without_prior_;
  std::map<double, Point> points_;
  std::map<double, std::optional<Eigen::MatrixXd>> covariances_;
};

}  // namespace jnd::analysis
