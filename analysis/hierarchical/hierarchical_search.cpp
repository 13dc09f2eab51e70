#include "analysis/hierarchical/hierarchical_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "analysis/fits/ceres_descent.h"

namespace jnd::analysis {
namespace {

/// Beyond this a number of the median person has run away: ln slope, say, to a step.
constexpr double kRunAway = 25.0;

/// Of a value or of one for each person, by each parameter in turn: central differences of
/// fourth order (Abramowitz and Stegun 25.3.6), handed to `take` with the parameter's place.
template <typename Function, typename Take>
void differentiate(const Function& function, const Eigen::VectorXd& at, const Take& take) {
  constexpr double kStep = 1e-4;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const auto value = [&](double step) {
      Eigen::VectorXd moved = at;
      moved(i) += step;
      return function(moved);
    };
    take(i, (8.0 * (value(kStep) - value(-kStep)) - value(2.0 * kStep) + value(-2.0 * kStep)) /
                (12.0 * kStep));
  }
}

/// Fisher's where there are several nodes; it is the exact integral's, and one node is too far
/// from that: then by differences.
Eigen::VectorXd gradient_of(const HierarchicalLikelihood& likelihood,
                            const Eigen::VectorXd& at) {
  Eigen::VectorXd gradient(at.size());
  if (!likelihood.is_laplace()) {
    (void)likelihood(at, &gradient);
    return gradient;
  }
  differentiate([&](const Eigen::VectorXd& moved) { return likelihood(moved); }, at,
                [&](Eigen::Index i, double slope) { gradient(i) = slope; });
  return gradient;
}

/// A column a person, as `gradient_of`, without the prior.
Eigen::MatrixXd scores_of(const HierarchicalLikelihood& likelihood, const Eigen::VectorXd& at) {
  Eigen::MatrixXd scores;
  if (!likelihood.is_laplace()) {
    (void)likelihood.of_people(at, &scores);
    return scores;
  }
  scores.resize(at.size(), static_cast<Eigen::Index>(likelihood.num_people()));
  differentiate([&](const Eigen::VectorXd& moved) { return likelihood.of_people(moved); }, at,
                [&](Eigen::Index i, const Eigen::VectorXd& slopes) {
                  scores.row(i) = slopes.transpose();
                });
  return scores;
}

/// `held`: a parameter that stays as it is; -1 for none.
Eigen::VectorXd roughly_most_likely(const HierarchicalLikelihood& likelihood,
                                    const Eigen::VectorXd& start, Eigen::Index held = -1) {
  const SmoothCost cost = [&](std::span<const double> x, double& value,
                              std::span<double> gradient) {
    const Eigen::VectorXd at =
        Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    Eigen::VectorXd rise;
    value = -likelihood(at, !likelihood.is_laplace() ? &rise : nullptr);
    if (likelihood.is_laplace()) rise = gradient_of(likelihood, at);
    if (held >= 0) rise(held) = 0.0;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
      gradient[i] = -rise(static_cast<Eigen::Index>(i));
    }
    return std::isfinite(value) && rise.allFinite();
  };
  const std::vector<double> found =
      ceres_minimum(cost, {start.data(), start.data() + start.size()});
  return Eigen::Map<const Eigen::VectorXd>(found.data(),
                                           static_cast<Eigen::Index>(found.size()));
}

/// Minus the second derivatives.
Eigen::MatrixXd information_at(const HierarchicalLikelihood& likelihood,
                               const Eigen::VectorXd& at, double here) {
  constexpr double kStep = 1e-3;
  Eigen::MatrixXd information(at.size(), at.size());
  if (!likelihood.is_laplace()) {
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(at.size(), i);
      information.col(i) =
          (gradient_of(likelihood, at - step) - gradient_of(likelihood, at + step)) /
          (2.0 * kStep);
    }
    return 0.5 * (information + information.transpose());
  }
  const auto value = [&](Eigen::Index i, double step_i, Eigen::Index j, double step_j) {
    Eigen::VectorXd moved = at;
    moved(i) += step_i;
    moved(j) += step_j;
    return likelihood(moved);
  };
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    information(i, i) =
        (2.0 * here - value(i, kStep, i, 0.0) - value(i, -kStep, i, 0.0)) / (kStep * kStep);
    for (Eigen::Index j = 0; j < i; ++j) {
      const double mixed = value(i, kStep, j, kStep) - value(i, kStep, j, -kStep) -
                           value(i, -kStep, j, kStep) + value(i, -kStep, j, -kStep);
      information(i, j) = information(j, i) = -mixed / (4.0 * kStep * kStep);
    }
  }
  return information;
}

struct Inverse {
  Eigen::MatrixXd matrix;
  bool rising = false;  ///< Along some direction the likelihood curves upwards.
};

/// Inverse over the directions that the likelihood knows; those it does not, such as a
/// correlation with something that does not vary, get nothing. Where it curves upwards, by the
/// magnitude, so that a step by it rises.
Inverse inverse_of(const Eigen::MatrixXd& information) {
  constexpr double kFlat = 1e-7;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  Inverse inverse;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(information.rows());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double value = eigen.eigenvalues()(i);
    if (std::fabs(value) > kFlat * largest) values(i) = 1.0 / std::fabs(value);
    inverse.rising = inverse.rising || value < -kFlat * largest;
  }
  inverse.matrix =
      eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
  return inverse;
}

/// Without a parameter's row, and column.
Eigen::VectorXd without(const Eigen::VectorXd& all, Eigen::Index held) {
  Eigen::VectorXd others(all.size() - 1);
  others << all.head(held), all.tail(all.size() - 1 - held);
  return others;
}

Eigen::MatrixXd without(const Eigen::MatrixXd& all, Eigen::Index held) {
  Eigen::MatrixXd others(all.rows() - 1, all.cols() - 1);
  for (Eigen::Index column = 0; column < others.cols(); ++column) {
    others.col(column) =
        without(Eigen::VectorXd(all.col(column < held ? column : column + 1)), held);
  }
  return others;
}

/// Back again, with 0 for the held one.
Eigen::VectorXd with_zero(const Eigen::VectorXd& others, Eigen::Index held) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(others.size() + 1);
  all.head(held) = others.head(held);
  all.tail(others.size() - held) = others.tail(others.size() - held);
  return all;
}

}  // namespace

Eigen::VectorXd most_likely_with(const HierarchicalLikelihood& likelihood,
                                 const Eigen::VectorXd& start, Eigen::Index held) {
  return roughly_most_likely(likelihood, start, held);
}

HierarchicalOptimum most_likely(const HierarchicalLikelihood& likelihood,
                                const Eigen::VectorXd& start) {
  constexpr int kMaxSteps = 30;
  constexpr double kSmallStep = 1e-8, kLargeStep = 1e-3, kLargestStep = 0.5;
  HierarchicalOptimum found;
  found.parameters = roughly_most_likely(likelihood, start);
  found.status = FitStatus::kNotConverged;
  found.reason = "the search for the optimum did not come to rest";
  Inverse inverse;
  for (int step_number = 0; step_number < kMaxSteps; ++step_number) {
    if (!(found.parameters.cwiseAbs().maxCoeff() < kRunAway)) {
      found.status = FitStatus::kDegenerate;
      found.is_separated = true;
      found.reason = "the likelihood rises without bound: the answers are nearly separated";
      return found;
    }
    // Where the curvature is still known, value and gradient come of one evaluation.
    Eigen::VectorXd rise;
    const bool has_rise = inverse.matrix.size() > 0 && !likelihood.is_laplace();
    found.log_likelihood = likelihood(found.parameters, has_rise ? &rise : nullptr);
    const auto inverse_here = [&] {
      return inverse_of(information_at(likelihood, found.parameters, found.log_likelihood));
    };
    // The curvature anew only while the steps are large.
    if (inverse.matrix.size() == 0) inverse = inverse_here();
    if (!has_rise) rise = gradient_of(likelihood, found.parameters);
    Eigen::VectorXd step = inverse.matrix * rise;
    const double size = step.cwiseAbs().maxCoeff();
    if (!std::isfinite(size)) return found;
    if (size <= kSmallStep) {
      inverse = inverse_here();
      if (inverse.rising) return found;
      found.covariance = std::move(inverse.matrix);
      const Eigen::MatrixXd scores = scores_of(likelihood, found.parameters);
      found.influence = found.covariance * (scores.colwise() - scores.rowwise().mean().eval());
      found.status = FitStatus::kOk;
      found.reason.clear();
      return found;
    }
    if (size > kLargestStep) step *= kLargestStep / size;
    found.parameters += step;
    if (size > kLargeStep) inverse.matrix.resize(0, 0);
  }
  return found;
}

Eigen::VectorXd rise_of(const HierarchicalLikelihood& likelihood, const Eigen::VectorXd& at) {
  return gradient_of(likelihood, at);
}

std::optional<Eigen::MatrixXd> covariance_without(const HierarchicalLikelihood& likelihood,
                                                  const Eigen::VectorXd& at,
                                                  Eigen::Index held) {
  Inverse inverse = inverse_of(without(information_at(likelihood, at, likelihood(at)), held));
  if (inverse.rising) return std::nullopt;
  return std::move(inverse.matrix);
}

std::optional<Eigen::VectorXd> most_likely_near(const HierarchicalLikelihood& likelihood,
                                                const Eigen::VectorXd& start, Eigen::Index held,
                                                Eigen::MatrixXd& inverse) {
  constexpr int kMaxSteps = 40;
  constexpr double kSmallStep = 1e-8, kLargestStep = 0.5, kSlowly = 0.3;
  Eigen::VectorXd at = start;
  double last_size = kLargestStep;
  for (int step_number = 0; step_number < kMaxSteps; ++step_number) {
    if (!(at.cwiseAbs().maxCoeff() < kRunAway)) return std::nullopt;
    const Eigen::VectorXd rise = without(gradient_of(likelihood, at), held);
    if (!rise.allFinite()) return std::nullopt;
    const auto renew = [&] {
      inverse =
          inverse_of(without(information_at(likelihood, at, likelihood(at)), held)).matrix;
    };
    if (inverse.size() == 0) renew();
    Eigen::VectorXd step = inverse * rise;
    double size = step.cwiseAbs().maxCoeff();
    if (size > kSmallStep && size > kSlowly * last_size) {
      renew();
      step = inverse * rise;
      size = step.cwiseAbs().maxCoeff();
    }
    if (!std::isfinite(size)) return std::nullopt;
    if (size <= kSmallStep) return at;
    if (size > kLargestStep) step *= kLargestStep / size;
    at += with_zero(step, held);
    last_size = size;
  }
  return std::nullopt;
}

HierarchicalOptimum better_optimum(const HierarchicalLikelihood& likelihood,
                                   const HierarchicalStructure& structure,
                                   const Eigen::VectorXd& start) {
  constexpr double kNoLapses = 1e-6, kSomeLapsesAngle = 0.2;  // 2 in a hundred.
  HierarchicalOptimum first = most_likely(likelihood, start);
  if (!structure.has_lapses) return first;
  const bool found_some =
      first.status == FitStatus::kOk && structure.lapse_rate(first.parameters) > kNoLapses;
  Eigen::VectorXd other = start;
  other(structure.angle_at()) = found_some ? 0.0 : kSomeLapsesAngle;
  HierarchicalOptimum second =
      most_likely(likelihood, most_likely_with(likelihood, other, structure.angle_at()));
  const bool is_better =
      first.status != FitStatus::kOk || second.log_likelihood > first.log_likelihood;
  return second.status == FitStatus::kOk && is_better ? second : first;
}

HeldSearch::HeldSearch(const HierarchicalLikelihood& likelihood, std::vector<int> even,
                       Eigen::VectorXd start, int held)
    : likelihood_(likelihood), even_(std::move(even)), start_(std::move(start)), held_(held) {}

/// Newton's method alone where that comes to rest. It cannot leave a spread of 0 where that is
/// no maximum any more, as there are more lapses: then from people who differ.
std::optional<Eigen::VectorXd> HeldSearch::from(Eigen::VectorXd near) {
  std::optional<Eigen::VectorXd> found = most_likely_near(likelihood_, near, held_, inverse_);
  if (found && is_maximum(*found)) return found;
  for (const int parameter : even_) near(parameter) = start_(parameter);
  inverse_.resize(0, 0);
  found = most_likely_near(likelihood_, most_likely_with(likelihood_, near, held_), held_,
                           inverse_);
  return found && is_maximum(*found) ? found : std::nullopt;
}

/// Where an even parameter is 0 the likelihood is level in it.
bool HeldSearch::is_maximum(const Eigen::VectorXd& at) const {
  constexpr double kNone = 1e-5, kStep = 1e-3;
  return std::ranges::none_of(even_, [&](const int parameter) {
    if (std::fabs(at(parameter)) > kNone) return false;
    Eigen::VectorXd beside = at;
    beside(parameter) = kStep;
    return likelihood_(beside) > likelihood_(at) + 1e-9;
  });
}

}  // namespace jnd::analysis
