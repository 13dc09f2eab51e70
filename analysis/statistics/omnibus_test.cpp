#include "analysis/statistics/omnibus_test.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/statistics/distributions.h"
#include "analysis/statistics/ranks.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// A matrix with people as rows and conditions as columns.
Eigen::MatrixXd table_of(const RepeatedMeasures& data) {
  const std::size_t width = data.values.empty() ? 0 : data.values.front().size();
  Eigen::MatrixXd table(data.values.size(), width);
  for (std::size_t person = 0; person < data.values.size(); ++person) {
    core::require(data.values[person].size() == width, "values of a person",
                  "one for each condition", static_cast<double>(data.values[person].size()));
    for (std::size_t condition = 0; condition < width; ++condition) {
      const double value = data.values[person][condition];
      core::require(std::isfinite(value), "value", "a finite number", value);
      table(static_cast<Eigen::Index>(person), static_cast<Eigen::Index>(condition)) = value;
    }
  }
  return table;
}

OmnibusTest started(const char* method, const char* statistic, const Eigen::MatrixXd& table) {
  OmnibusTest test{.status = FitStatus::kDegenerate, .method = method};
  test.num_people = static_cast<int>(table.rows());
  test.num_conditions = static_cast<int>(table.cols());
  test.statistic_name = statistic;
  if (table.rows() < 2 || table.cols() < 2) {
    test.reason =
        "too few values: the test needs two people or more under two conditions or more";
  }
  return test;
}

/// Subtracts from each value its person's mean, and from the result its condition's mean.
Eigen::MatrixXd residuals_of(const Eigen::MatrixXd& table) {
  Eigen::MatrixXd rest = table.colwise() - table.rowwise().mean();
  rest.rowwise() -= rest.colwise().mean().eval();
  return rest;
}

SphericityCorrection corrected(double epsilon, const OmnibusTest& test) {
  return {.epsilon = epsilon,
          .p_value = fisher_f_above(*test.statistic, epsilon * *test.degrees_of_freedom,
                                    epsilon * *test.error_degrees_of_freedom)};
}

void correct_for_sphericity(OmnibusTest& test, const Eigen::MatrixXd& rest) {
  // Rows and columns of this covariance sum to 0, so it is the covariance of all contrasts of
  // conditions.
  const Eigen::MatrixXd covariance = rest.transpose() * rest;
  const double trace = covariance.trace();
  const double n = test.num_people, contrasts = *test.degrees_of_freedom;
  const double epsilon =
      std::clamp(trace * trace / (contrasts * covariance.squaredNorm()), 1.0 / contrasts, 1.0);
  test.greenhouse_geisser = corrected(epsilon, test);
  const double above = n * contrasts * epsilon - 2.0;
  const double below = contrasts * (n - 1.0 - contrasts * epsilon);
  // With no more people than conditions the Huynh-Feldt correction diverges. It is never below
  // the other correction.
  test.huynh_feldt =
      corrected(below > 0.0 ? std::clamp(above / below, epsilon, 1.0) : 1.0, test);
}

/// Mauchly's W from the eigenvalues of the covariance of all contrasts, the smallest of which
/// is that of the mean and 0. The p value follows Anderson (2003, section 10.7) to second
/// order.
void test_sphericity(OmnibusTest& test, const Eigen::MatrixXd& rest) {
  const double p = *test.degrees_of_freedom, n = test.num_people - 1.0;
  if (p < 2.0 || n < p) return;
  const Eigen::MatrixXd covariance = rest.transpose() * rest;
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance, Eigen::EigenvaluesOnly)
          .eigenvalues()
          .tail(covariance.cols() - 1);
  // A condition that follows from others leaves an eigenvalue of nothing but rounding.
  constexpr double kRounding = 1e-12;
  if (!(values.minCoeff() > kRounding * values.maxCoeff())) return;
  const double log_w = values.array().log().sum() - p * std::log(values.sum() / p);
  const double factor = 1.0 - (2.0 * p * p + p + 2.0) / (6.0 * p * n);
  SphericityTest sphericity;
  sphericity.w = std::exp(log_w);
  sphericity.degrees_of_freedom = p * (p + 1.0) / 2.0 - 1.0;
  sphericity.chi_squared = std::max(0.0, -n * factor * log_w);
  const double first = chi_squared_above(sphericity.chi_squared, sphericity.degrees_of_freedom);
  const double second =
      chi_squared_above(sphericity.chi_squared, sphericity.degrees_of_freedom + 4.0);
  const double weight = (p + 2.0) * (p - 1.0) * (p - 2.0) *
                        (2.0 * p * p * p + 6.0 * p * p + 3.0 * p + 2.0) /
                        (288.0 * std::pow(n * p * factor, 2.0));
  sphericity.p_value = std::clamp(first + weight * (second - first), 0.0, 1.0);
  test.mauchly = sphericity;
}

}  // namespace

OmnibusTest repeated_measures_anova(const RepeatedMeasures& data) {
  const Eigen::MatrixXd table = table_of(data);
  OmnibusTest test = started("analysis of variance of repeated measures", "F", table);
  if (!test.reason.empty()) return test;
  const double n = test.num_people, k = test.num_conditions;
  const double mean = table.mean();
  const double of_conditions =
      n * (table.colwise().mean().array() - mean).matrix().squaredNorm();
  const double of_people = k * (table.rowwise().mean().array() - mean).matrix().squaredNorm();
  const Eigen::MatrixXd rest = residuals_of(table);
  const double of_errors = rest.squaredNorm();
  test.degrees_of_freedom = k - 1.0;
  test.error_degrees_of_freedom = (n - 1.0) * (k - 1.0);
  const double largest = table.cwiseAbs().maxCoeff();
  constexpr double kRounding = 1e-24;
  if (!(of_errors > kRounding * n * k * largest * largest)) {
    test.reason = of_conditions > kRounding * n * k * largest * largest
                      ? "everybody changes alike from condition to condition: F is infinite"
                      : "nobody's values change from condition to condition: there is nothing "
                        "to test";
    return test;
  }
  test.statistic =
      of_conditions / *test.degrees_of_freedom / (of_errors / *test.error_degrees_of_freedom);
  test.p_value =
      fisher_f_above(*test.statistic, *test.degrees_of_freedom, *test.error_degrees_of_freedom);
  test.partial_eta_squared = of_conditions / (of_conditions + of_errors);
  test.generalized_eta_squared = of_conditions / (of_conditions + of_people + of_errors);
  correct_for_sphericity(test, rest);
  test_sphericity(test, rest);
  test.status = FitStatus::kOk;
  return test;
}

OmnibusTest friedman_test(const RepeatedMeasures& data) {
  const Eigen::MatrixXd table = table_of(data);
  OmnibusTest test = started("Friedman's ranks", "chi_squared", table);
  if (!test.reason.empty()) return test;
  const double n = test.num_people, k = test.num_conditions;
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(table.cols());
  double ties = 0.0;
  for (const std::vector<double>& values : data.values) {
    const Ranks ranks = ranks_of(values);
    ties += ranks.tie_correction;
    for (Eigen::Index condition = 0; condition < sums.size(); ++condition) {
      sums[condition] +=
          0.5 * static_cast<double>(ranks.doubled[static_cast<std::size_t>(condition)]);
    }
  }
  const double spread = (sums.array() - 0.5 * n * (k + 1.0)).matrix().squaredNorm();
  const double scale = n * k * (k + 1.0) - ties / (k - 1.0);
  if (!(scale > 0.0)) {
    test.reason = "everybody's values are alike: there is nothing to rank";
    return test;
  }
  test.statistic = 12.0 * spread / scale;
  test.degrees_of_freedom = k - 1.0;
  test.p_value = chi_squared_above(*test.statistic, *test.degrees_of_freedom);
  test.concordance = *test.statistic / (n * (k - 1.0));
  test.status = FitStatus::kOk;
  return test;
}

}  // namespace jnd::analysis
