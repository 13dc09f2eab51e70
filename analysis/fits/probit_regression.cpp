#include "analysis/fits/probit_regression.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "analysis/fits/normal_tail.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// The log-likelihood and its derivatives at one point.
struct Likelihood {
  double value = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

Likelihood likelihood_at(const Eigen::MatrixXd& design, const Eigen::VectorXd& num_yes,
                         const Eigen::VectorXd& num_trials, const Eigen::VectorXd& offset,
                         const Eigen::VectorXd& beta) {
  Likelihood here{0.0, Eigen::VectorXd::Zero(beta.size()),
                  Eigen::MatrixXd::Zero(beta.size(), beta.size())};
  Eigen::VectorXd x(beta.size());
  for (Eigen::Index row = 0; row < design.rows(); ++row) {
    x = design.row(row).transpose();
    const double z = offset(row) + x.dot(beta), yes = num_yes(row);
    const double no = num_trials(row) - yes;
    const LogNormalTails tails = log_normal_tails(z);
    if (yes > 0.0) here.value += yes * tails.log_lower;
    if (no > 0.0) here.value += no * tails.log_upper;
    here.gradient += (yes * tails.mills_lower - no * tails.mills_upper) * x;
    here.information += (yes * tails.mills_lower * (z + tails.mills_lower) +
                         no * tails.mills_upper * (tails.mills_upper - z)) *
                        x * x.transpose();
  }
  return here;
}

/// Whether a column has almost no information left after the columns before it. The columns are
/// linearly independent, so the answers that tell them apart lie far out on the curve, as
/// separated answers do. What is left is rounding, which must not decide whether there is a
/// fit.
bool is_of_rounding(const Eigen::LLT<Eigen::MatrixXd>& cholesky,
                    const Eigen::MatrixXd& information) {
  constexpr double kLeast = 1e-12;
  const Eigen::MatrixXd lower = cholesky.matrixL();
  for (Eigen::Index column = 0; column < lower.cols(); ++column) {
    const double left = lower(column, column) * lower(column, column);
    if (!(left > kLeast * information(column, column))) return true;
  }
  return false;
}

}  // namespace

ProbitRegression fit_probit(const Eigen::MatrixXd& design, const Eigen::VectorXd& num_yes,
                            const Eigen::VectorXd& num_trials, const Eigen::VectorXd& offset) {
  constexpr int kMaxSteps = 60, kMaxHalvings = 40;
  constexpr double kSmallStep = 1e-10, kDependent = 1e-12;
  core::require(num_yes.size() == design.rows() && num_trials.size() == design.rows(), "rows",
                "as many counts as rows of the design", static_cast<double>(num_yes.size()));
  core::require(offset.size() == 0 || offset.size() == design.rows(), "offset",
                "as many as rows of the design", static_cast<double>(offset.size()));
  const Eigen::VectorXd known =
      offset.size() > 0 ? offset : Eigen::VectorXd(Eigen::VectorXd::Zero(design.rows()));
  ProbitRegression fit;
  fit.status = FitStatus::kDegenerate;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> columns(
      design.transpose() * num_trials.asDiagonal() * design, Eigen::EigenvaluesOnly);
  if (!(columns.eigenvalues()(0) > kDependent * columns.eigenvalues().maxCoeff())) {
    fit.reason = "not identified: the columns depend on one another";
    return fit;
  }
  fit.coefficients = Eigen::VectorXd::Zero(design.cols());
  const auto at = [&](const Eigen::VectorXd& coefficients) {
    return likelihood_at(design, num_yes, num_trials, known, coefficients);
  };
  Likelihood here = at(fit.coefficients);
  fit.log_likelihood = here.value;
  // The sum has so many terms that rounding limits its accuracy to this value.
  const double rounding = std::max(1e-13, 1e-16 * static_cast<double>(design.rows()));
  double largest = 0.0;
  for (int step_number = 0; step_number < kMaxSteps; ++step_number) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky(here.information);
    if (cholesky.info() != Eigen::Success || is_of_rounding(cholesky, here.information)) break;
    Eigen::VectorXd step = cholesky.solve(here.gradient);
    largest = (design * step).cwiseAbs().maxCoeff();
    if (largest <= kSmallStep) {
      fit.status = FitStatus::kOk;
      fit.covariance = cholesky.solve(Eigen::MatrixXd::Identity(design.cols(), design.cols()));
      return fit;
    }
    const double least = fit.log_likelihood - rounding * std::fabs(fit.log_likelihood);
    bool is_higher = false;
    for (int halving = 0; halving < kMaxHalvings; ++halving) {
      here = at(fit.coefficients + step);
      is_higher = here.value >= least;
      if (is_higher) break;
      step *= 0.5;
    }
    fit.coefficients += step;
    fit.log_likelihood = here.value;
    if (!is_higher) here = at(fit.coefficients);
  }
  // Separated answers move the curve ever further, by at least a third of z in each step.
  constexpr double kAtRest = 1e-3;
  if (largest < kAtRest) {
    fit.reason = "not found: the search did not come to rest; add up rows that ask the same";
    return fit;
  }
  fit.is_separated = true;
  fit.reason = "separated: some combination of the columns splits the answers without overlap";
  return fit;
}

}  // namespace jnd::analysis
