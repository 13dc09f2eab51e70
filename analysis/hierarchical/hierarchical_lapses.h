#pragma once

#include <map>

#include "analysis/hierarchical/hierarchical_search.h"

namespace jnd::analysis {

/// The profile of the log-likelihood over the lapse rate, with everything else most likely at
/// each rate. It shows what answers and prior tell about the lapse rate, and how far the rate
/// moves the other parameters. If people have lapse rates of their own, it is over the median
/// person's rate. The prior then also moves their spread, so there is no profile without it.
class LapseProfile {
 public:
  /// The optimum of everything else at one lapse rate.
  struct Point {
    bool exists = false;          ///< Whether there is a curve at this lapse rate.
    Eigen::VectorXd parameters;   ///< All parameters, including the lapse rate's.
    double log_likelihood = 0.0;  ///< The log-likelihood of the answers, without the prior.
    double rise = 0.0;            ///< Its derivative by the lapse rate; 0 at a rate of 0.
  };

  /// `found` is the optimum with the prior. `start` is where its search started, with people
  /// who differ. The references must outlive the profile.
  LapseProfile(const HierarchicalLikelihood& likelihood, const HierarchicalStructure& structure,
               Eigen::VectorXd start, const HierarchicalOptimum& found);

  /// `lapse_rate` is in [0, `lapse_limit`).
  const Point& at(double lapse_rate);

  /// The variance of a parameter other than the lapse rate's, if the lapse rate were known. It
  /// is absent if there is no curve.
  [[nodiscard]] std::optional<double> variance_at(double lapse_rate, int parameter);

  /// The lapse rate that answers and prior make most likely.
  [[nodiscard]] double with_prior() const noexcept { return with_prior_; }

  /// The lapse rate that the answers alone make most likely. It must not be called if people
  /// have lapse rates of their own.
  [[nodiscard]] double without_prior();

  /// The interval in which the log-likelihood, with or without the log prior, is less than half
  /// the 95 % quantile of chi-squared (one degree of freedom) below its maximum. The low end is
  /// 0 if it has not fallen that far there. The high end is open if it has not fallen that far
  /// before nine in ten answers are random, or before there is no curve.
  [[nodiscard]] Interval interval(bool has_prior);

 private:
  /// The profile's value at one of its points.
  [[nodiscard]] double height(double lapse_rate, bool has_prior);
  [[nodiscard]] std::optional<double> end(double from, bool has_prior, double direction);
  /// An estimate of the parameters at a lapse rate, from the points that are known.
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
