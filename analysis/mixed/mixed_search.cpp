#include "analysis/mixed/mixed_search.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace jnd::analysis {
namespace {

constexpr int kMostClimbs = 300;
/// The longest step of one parameter. All parameters are of the order of 1.
constexpr double kLongestStep = 2.0;
/// A fixed effect with a larger standard error, in units of its column's root mean square, is
/// unbounded on one side.
constexpr double kUnboundedError = 100.0;

/// Minus the second derivatives, by central differences of the gradient.
bool information_at(MixedLikelihood& likelihood, const Eigen::VectorXd& at,
                    Eigen::MatrixXd& information) {
  constexpr double kStep = 1e-4;
  const Eigen::Index num = at.size();
  information.resize(num, num);
  Eigen::VectorXd above(num), below(num);
  for (Eigen::Index i = 0; i < num; ++i) {
    Eigen::VectorXd moved = at;
    moved[i] = at[i] + kStep;
    if (!likelihood.value(moved, above)) return false;
    moved[i] = at[i] - kStep;
    if (!likelihood.value(moved, below)) return false;
    information.col(i) = (below - above) / (2.0 * kStep);
  }
  information = (0.5 * (information + information.transpose())).eval();
  return information.allFinite();
}

/// The inverse over the directions in which the information is positive.
Eigen::MatrixXd inverse_of(const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& solver) {
  const Eigen::VectorXd& values = solver.eigenvalues();
  const double least = 1e-9 * values.cwiseAbs().maxCoeff();
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i] > least) inverse[i] = 1.0 / values[i];
  }
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

/// The fixed effect that dominates a flat direction; -1 if no direction is flat.
int unbounded_effect(const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& solver,
                     int num_fixed) {
  const Eigen::VectorXd& values = solver.eigenvalues();
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto fixed = solver.eigenvectors().col(i).head(num_fixed);
    if (values[i] * kUnboundedError * kUnboundedError > 1.0 || fixed.norm() < 0.5) continue;
    Eigen::Index most = 0;
    fixed.cwiseAbs().maxCoeff(&most);
    return static_cast<int>(most);
  }
  return -1;
}

}  // namespace

bool climb(MixedLikelihood& likelihood, Eigen::VectorXd& parameters, Eigen::MatrixXd& inverse,
           double& log_likelihood) {
  Eigen::VectorXd gradient;
  std::optional<double> height = likelihood.value(parameters, gradient);
  if (!height) return false;
  bool is_first = true;
  for (int step = 0; step < kMostClimbs; ++step) {
    log_likelihood = *height;
    Eigen::VectorXd move = inverse * gradient;
    double slope = move.dot(gradient);
    if (!(slope > 0.0)) {
      inverse.setIdentity();
      move = gradient;
      slope = gradient.squaredNorm();
    }
    if (slope < 1e-12) return true;
    double share = std::min(1.0, kLongestStep / move.cwiseAbs().maxCoeff());
    std::optional<double> there;
    Eigen::VectorXd moved, gradient_there;
    for (; share > 1e-12; share *= 0.4) {
      moved = parameters + share * move;
      there = likelihood.value(moved, gradient_there);
      if (there && *there >= *height + 1e-4 * share * slope) break;
      // Near the top a rise is smaller than rounding.
      if (there && share == 1.0 && slope < 1e-8 && *there > *height - 1e-9) break;
      there.reset();
    }
    if (!there) return slope < 1e-6;
    const Eigen::VectorXd way = moved - parameters, bend = gradient - gradient_there;
    const double curved = way.dot(bend);
    if (curved > 1e-12 * way.norm() * bend.norm()) {
      if (is_first) inverse *= curved / bend.dot(inverse * bend);
      is_first = false;
      const Eigen::VectorXd image = inverse * bend;
      inverse += ((1.0 + bend.dot(image) / curved) / curved) * way * way.transpose() -
                 (image * way.transpose() + way * image.transpose()) / curved;
    }
    parameters = moved;
    gradient = gradient_there;
    height = there;
  }
  log_likelihood = *height;
  return false;
}

std::optional<int> unbounded_effect(MixedLikelihood& likelihood, const Eigen::VectorXd& at,
                                    int num_fixed) {
  Eigen::MatrixXd information;
  if (!information_at(likelihood, at, information)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
  return unbounded_effect(solver, num_fixed);
}

MixedOptimum most_likely(MixedLikelihood& likelihood, const Eigen::VectorXd& start,
                         int num_fixed) {
  MixedOptimum optimum;
  optimum.parameters = start;
  const auto fail = [&optimum](FitStatus status, const std::string& reason) {
    optimum.status = status;
    optimum.reason = reason;
    return optimum;
  };
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(start.size(), start.size());
  Eigen::MatrixXd information;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  constexpr int kMostPlaces = 4;
  for (int place = 0; place < kMostPlaces; ++place) {
    const bool at_rest = climb(likelihood, optimum.parameters, inverse, optimum.log_likelihood);
    if (!information_at(likelihood, optimum.parameters, information)) {
      return fail(FitStatus::kNotConverged,
                  "the search left the range of numbers; give covariates in units in which "
                  "they are of the order of 1");
    }
    solver.compute(information);
    optimum.unbounded = unbounded_effect(solver, num_fixed);
    if (optimum.unbounded >= 0) return fail(FitStatus::kDegenerate, "");
    if (solver.eigenvalues()[0] > -1e-5 * solver.eigenvalues().cwiseAbs().maxCoeff()) {
      if (!at_rest && place + 1 < kMostPlaces) continue;
      break;
    }
    optimum.parameters += 0.3 * solver.eigenvectors().col(0);
    inverse = Eigen::MatrixXd::Identity(start.size(), start.size());
  }
  optimum.covariance = inverse_of(solver);
  Eigen::VectorXd gradient;
  constexpr int kMostSteps = 8;
  double left = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    const std::optional<double> height = likelihood.value(optimum.parameters, gradient);
    if (!height) break;
    optimum.log_likelihood = *height;
    const Eigen::VectorXd move = optimum.covariance * gradient;
    left = move.dot(gradient);
    if (left < 1e-16 || move.cwiseAbs().maxCoeff() > 0.1) break;
    optimum.parameters += move;
  }
  if (!(left < 1e-6)) {
    return fail(FitStatus::kNotConverged,
                "the search did not come to rest; a simpler formula of the random effects may");
  }
  optimum.status = FitStatus::kOk;
  return optimum;
}

Eigen::VectorXd fixed_start(const MixedModel& model) {
  const Eigen::Index num = model.x.cols();
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(num);
  const auto log_likelihood_at = [&](const Eigen::VectorXd& at) {
    const Eigen::VectorXd eta = model.x * at;
    double sum = 0.0;
    for (std::size_t row = 0; row < model.num_rows(); ++row) {
      const double yes = model.num_yes[row], no = model.num_trials[row] - yes;
      const MixedCurvePoint p = curve_point(model.curve, eta[static_cast<Eigen::Index>(row)]);
      sum += (yes > 0.0 ? yes * p.log_yes : 0.0) + (no > 0.0 ? no * p.log_no : 0.0);
    }
    return sum;
  };
  double height = log_likelihood_at(beta);
  constexpr int kMostSteps = 12;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd eta = model.x * beta;
    Eigen::VectorXd score(eta.size()), weight(eta.size());
    for (std::size_t row = 0; row < model.num_rows(); ++row) {
      const auto at = static_cast<Eigen::Index>(row);
      const double yes = model.num_yes[row], trials = model.num_trials[row];
      const MixedCurvePoint p = curve_point(model.curve, eta[at]);
      score[at] = yes * p.rise_yes - (trials - yes) * p.rise_no;
      weight[at] = trials * p.rise_yes * p.rise_no;
    }
    // Slightly more than the information, so that separated answers also give a start.
    Eigen::MatrixXd information = model.x.transpose() * weight.asDiagonal() * model.x;
    information.diagonal().array() += 1e-3;
    Eigen::VectorXd move = information.ldlt().solve(model.x.transpose() * score);
    if (!move.allFinite()) break;
    const double gain = move.dot(model.x.transpose() * score);
    double there = log_likelihood_at(beta + move);
    while (!(there >= height) && move.norm() > 1e-8) {
      move *= 0.5;
      there = log_likelihood_at(beta + move);
    }
    if (!(there >= height)) break;
    beta += move;
    height = there;
    if (gain < 1e-4) break;
  }
  return beta;
}

}  // namespace jnd::analysis
