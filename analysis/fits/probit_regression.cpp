#include "analysis/fits/probit_regression.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "analysis/fits/normal_tail.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

struct Derivatives {
  double value = 0.0;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
};

Derivatives derivatives_at(const Eigen::MatrixXd& design, const Eigen::VectorXd& num_yes,
                           const Eigen::VectorXd& num_trials, const Eigen::VectorXd& beta) {
  Derivatives here{0.0, Eigen::VectorXd::Zero(beta.size()),
                   Eigen::MatrixXd::Zero(beta.size(), beta.size())};
  for (Eigen::Index row = 0; row < design.rows(); ++row) {
    const Eigen::VectorXd x = design.row(row).transpose();
    const double z = x.dot(beta), yes = num_yes(row), no = num_trials(row) - yes;
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

}  // namespace

ProbitRegression fit_probit(const Eigen::MatrixXd& design, const Eigen::VectorXd& num_yes,
                            const Eigen::VectorXd& num_trials) {
  constexpr int kMaxSteps = 60, kMaxHalvings = 40;
  constexpr double kSmallStep = 1e-10, kDependent = 1e-12;
  core::require(num_yes.size() == design.rows() && num_trials.size() == design.rows(), "rows",
                "as many counts as rows of the design", static_cast<double>(num_yes.size()));
  ProbitRegression fit;
  fit.status = FitStatus::kDegenerate;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> columns(
      design.transpose() * num_trials.asDiagonal() * design, Eigen::EigenvaluesOnly);
  if (!(columns.eigenvalues()(0) > kDependent * columns.eigenvalues().maxCoeff())) {
    fit.reason = "not identified: the columns depend on one another";
    return fit;
  }
  fit.coefficients = Eigen::VectorXd::Zero(design.cols());
  for (int step_number = 0; step_number < kMaxSteps; ++step_number) {
    const Derivatives here = derivatives_at(design, num_yes, num_trials, fit.coefficients);
    fit.log_likelihood = here.value;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(here.information);
    if (cholesky.info() != Eigen::Success) break;
    Eigen::VectorXd step = cholesky.solve(here.gradient);
    const double largest = (design * step).cwiseAbs().maxCoeff();
    if (largest <= kSmallStep) {
      fit.status = FitStatus::kOk;
      fit.covariance = cholesky.solve(Eigen::MatrixXd::Identity(design.cols(), design.cols()));
      return fit;
    }
    const auto value_at = [&](const Eigen::VectorXd& beta) {
      return derivatives_at(design, num_yes, num_trials, beta).value;
    };
    const double least = here.value - 1e-13 * std::fabs(here.value);
    for (int halving = 0; halving < kMaxHalvings; ++halving) {
      if (value_at(fit.coefficients + step) >= least) break;
      step *= 0.5;
    }
    fit.coefficients += step;
  }
  fit.reason = "separated: some combination of the columns splits the answers without overlap";
  return fit;
}

}  // namespace jnd::analysis
