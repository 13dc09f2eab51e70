#include "analysis/hierarchical/hierarchical_search.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "analysis/fits/ceres_descent.h"

namespace jnd::analysis {
namespace {

/// A number of the median person beyond this has diverged. For example, ln slope then tends to
/// a step.
constexpr double kRunAway = 25.0;
constexpr char kNotAtRest[] = "the search for the optimum did not come to rest";

/// Differentiates a value, or one value for each person, by each parameter in turn, and passes
/// the derivative with the parameter's index to `take`. It uses central differences of fourth
/// order (Abramowitz and Stegun 25.3.6).
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

/// Fisher's gradient if there are several nodes. It is that of the exact integral, from which a
/// single node differs too much, so a single node uses differences.
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

/// The scores, with one column for each person, computed like `gradient_of` without the prior.
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

/// `held` is a parameter that keeps its value; -1 for none.
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

/// Removes a parameter's row. It removes nothing if none is held (-1).
Eigen::VectorXd without(const Eigen::VectorXd& all, Eigen::Index held) {
  if (held < 0) return all;
  Eigen::VectorXd others(all.size() - 1);
  others << all.head(held), all.tail(all.size() - 1 - held);
  return others;
}

/// Inserts the held parameter again, with the value 0.
Eigen::VectorXd with_zero(const Eigen::VectorXd& others, Eigen::Index held) {
  if (held < 0) return others;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(others.size() + 1);
  all.head(held) = others.head(held);
  all.tail(others.size() - held) = others.tail(others.size() - held);
  return all;
}

/// Minus the second derivatives by all parameters except the held one, or by all (-1). `here`
/// is the value at `at`.
Eigen::MatrixXd information_at(const HierarchicalLikelihood& likelihood,
                               const Eigen::VectorXd& at, double here, Eigen::Index held = -1) {
  constexpr double kStep = 1e-3;
  std::vector<Eigen::Index> moving;
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    if (i != held) moving.push_back(i);
  }
  const auto size = static_cast<Eigen::Index>(moving.size());
  const auto parameter = [&](Eigen::Index i) { return moving[static_cast<std::size_t>(i)]; };
  Eigen::MatrixXd information(size, size);
  if (!likelihood.is_laplace()) {
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(at.size(), parameter(i));
      information.col(i) =
          without((gradient_of(likelihood, at - step) - gradient_of(likelihood, at + step)) /
                      (2.0 * kStep),
                  held);
    }
    return 0.5 * (information + information.transpose());
  }
  const auto value = [&](Eigen::Index i, double step_i, Eigen::Index j, double step_j) {
    Eigen::VectorXd moved = at;
    moved(parameter(i)) += step_i;
    moved(parameter(j)) += step_j;
    return likelihood(moved);
  };
  for (Eigen::Index i = 0; i < size; ++i) {
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
  bool rising = false;  ///< Whether the likelihood curves upwards in some direction.
};

/// The inverse over the directions that the likelihood determines. Other directions, such as a
/// correlation with something that does not vary, get 0. If the likelihood curves upwards, the
/// magnitude of the curvature is used, so that a step leads uphill.
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

/// Updates an inverse of the information from a step and the change of the gradient over it
/// (Broyden, Fletcher, Goldfarb and Shanno). A step near rounding is ignored.
void learn(Eigen::MatrixXd& inverse, const Eigen::VectorXd& step, const Eigen::VectorXd& fall) {
  constexpr double kSmallStep = 1e-6;
  const double product = step.dot(fall);
  if (!(step.cwiseAbs().maxCoeff() > kSmallStep && product > 0.0)) return;
  const Eigen::VectorXd known = inverse * fall;
  const Eigen::MatrixXd crossed = step * known.transpose();
  inverse += (1.0 + fall.dot(known) / product) / product * step * step.transpose() -
             (crossed + crossed.transpose()) / product;
}

/// Newton's method from a nearby start, with one parameter or none (-1) held. `inverse` is that
/// of the information there over the moving parameters, or empty. With many people it is
/// updated from each step. It is computed anew if the steps do not shrink and, with few people
/// and no held parameter, as long as they are large. The result has no covariance.
HierarchicalOptimum climbed(const HierarchicalLikelihood& likelihood,
                            const Eigen::VectorXd& start, Eigen::Index held,
                            Eigen::MatrixXd& inverse) {
  constexpr double kSmallStep = 1e-8, kLargeStep = 1e-3, kLargestStep = 0.5, kSlowly = 0.3;
  const int most_steps = held < 0 ? 30 : 40;
  const bool learns = likelihood.reads_a_table();
  const bool goes_by_size = !learns && held < 0;
  HierarchicalOptimum found;
  found.parameters = start;
  found.status = FitStatus::kNotConverged;
  found.reason = kNotAtRest;
  Eigen::VectorXd& at = found.parameters;
  double last_size = kLargestStep;
  Eigen::VectorXd last_step, last_rise;
  for (int step_number = 0; step_number < most_steps; ++step_number) {
    if (!(at.cwiseAbs().maxCoeff() < kRunAway)) {
      found.status = FitStatus::kDegenerate;
      found.is_separated = true;
      found.reason = "the likelihood rises without bound: the answers are nearly separated";
      return found;
    }
    const Eigen::VectorXd rise = without(gradient_of(likelihood, at), held);
    if (!rise.allFinite()) return found;
    const bool is_new = inverse.size() == 0;
    const auto renew = [&] {
      inverse = inverse_of(information_at(likelihood, at, likelihood(at), held)).matrix;
    };
    if (is_new) {
      renew();
    } else if (learns && last_step.size() > 0) {
      learn(inverse, last_step, last_rise - rise);
    }
    Eigen::VectorXd step = inverse * rise;
    double size = step.cwiseAbs().maxCoeff();
    if (!is_new && !goes_by_size && size > kSmallStep && size > kSlowly * last_size) {
      renew();
      step = inverse * rise;
      size = step.cwiseAbs().maxCoeff();
    }
    if (!std::isfinite(size)) return found;
    if (size <= kSmallStep) {
      found.log_likelihood = likelihood(at);
      found.status = FitStatus::kOk;
      found.reason.clear();
      return found;
    }
    if (size > kLargestStep) step *= kLargestStep / size;
    at += with_zero(step, held);
    last_size = size;
    last_step = step;
    last_rise = rise;
    if (goes_by_size && size > kLargeStep) inverse.resize(0, 0);
  }
  return found;
}

/// A search from far away. Ceres climbs first. With many people it uses the coarser rule, whose
/// optimum is near that of the likelihood itself.
HierarchicalOptimum climbed_from_afar(const HierarchicalLikelihood& likelihood,
                                      const Eigen::VectorXd& start) {
  Eigen::MatrixXd inverse;
  if (const auto coarser = likelihood.coarser()) {
    HierarchicalOptimum found =
        climbed(likelihood, roughly_most_likely(*coarser, start), -1, inverse);
    if (found.status == FitStatus::kOk) return found;
    inverse.resize(0, 0);
  }
  return climbed(likelihood, roughly_most_likely(likelihood, start), -1, inverse);
}

/// Adds covariance and influence to an optimum. The optimum is rejected if the likelihood rises
/// in some direction.
HierarchicalOptimum with_covariance(const HierarchicalLikelihood& likelihood,
                                    HierarchicalOptimum found) {
  if (found.status != FitStatus::kOk) return found;
  Eigen::MatrixXd scores;
  // Scores are computed here because differences would move away from where the search was
  // last.
  if (!likelihood.is_laplace()) scores = scores_of(likelihood, found.parameters);
  Inverse inverse =
      inverse_of(information_at(likelihood, found.parameters, found.log_likelihood));
  if (inverse.rising) {
    found.status = FitStatus::kNotConverged;
    found.reason = kNotAtRest;
    return found;
  }
  if (likelihood.is_laplace()) scores = scores_of(likelihood, found.parameters);
  found.covariance = std::move(inverse.matrix);
  found.influence = found.covariance * (scores.colwise() - scores.rowwise().mean().eval());
  return found;
}

}  // namespace

Eigen::VectorXd most_likely_with(const HierarchicalLikelihood& likelihood,
                                 const Eigen::VectorXd& start, Eigen::Index held) {
  const auto coarser = likelihood.coarser();
  return roughly_most_likely(coarser ? *coarser : likelihood, start, held);
}

HierarchicalOptimum most_likely(const HierarchicalLikelihood& likelihood,
                                const Eigen::VectorXd& start) {
  return with_covariance(likelihood, climbed_from_afar(likelihood, start));
}

Eigen::VectorXd rise_of(const HierarchicalLikelihood& likelihood, const Eigen::VectorXd& at) {
  return gradient_of(likelihood, at);
}

std::optional<Eigen::MatrixXd> covariance_without(const HierarchicalLikelihood& likelihood,
                                                  const Eigen::VectorXd& at,
                                                  Eigen::Index held) {
  Inverse inverse = inverse_of(information_at(likelihood, at, likelihood(at), held));
  if (inverse.rising) return std::nullopt;
  return std::move(inverse.matrix);
}

std::optional<Eigen::VectorXd> most_likely_near(const HierarchicalLikelihood& likelihood,
                                                const Eigen::VectorXd& start, Eigen::Index held,
                                                Eigen::MatrixXd& inverse) {
  HierarchicalOptimum found = climbed(likelihood, start, held, inverse);
  if (found.status != FitStatus::kOk) return std::nullopt;
  return std::move(found.parameters);
}

HierarchicalOptimum better_optimum(const HierarchicalLikelihood& likelihood,
                                   const HierarchicalStructure& structure,
                                   const Eigen::VectorXd& start) {
  // This angle gives about 2 lapses in a hundred.
  constexpr double kNoLapses = 1e-6, kSomeLapsesAngle = 0.2;
  HierarchicalOptimum first = most_likely(likelihood, start);
  if (!structure.has_lapses) return first;
  const bool found_some =
      first.status == FitStatus::kOk && structure.lapse_rate(first.parameters) > kNoLapses;
  Eigen::VectorXd other = start;
  other(structure.angle_at()) = found_some ? 0.0 : kSomeLapsesAngle;
  HierarchicalOptimum second =
      climbed_from_afar(likelihood, most_likely_with(likelihood, other, structure.angle_at()));
  const bool is_better =
      first.status != FitStatus::kOk || second.log_likelihood > first.log_likelihood;
  if (second.status != FitStatus::kOk || !is_better) return first;
  second = with_covariance(likelihood, std::move(second));
  return second.status == FitStatus::kOk ? second : first;
}

HeldSearch::HeldSearch(const HierarchicalLikelihood& likelihood, std::vector<int> even,
                       Eigen::VectorXd start, int held)
    : likelihood_(likelihood), even_(std::move(even)), start_(std::move(start)), held_(held) {}

/// Newton's method alone, if it comes to rest. With more lapses a spread of 0 may no longer be
/// a maximum, but Newton's method cannot leave it. The search then starts from people who
/// differ.
std::optional<Eigen::VectorXd> HeldSearch::from(Eigen::VectorXd near) {
  std::optional<Eigen::VectorXd> found = most_likely_near(likelihood_, near, held_, inverse_);
  if (found && is_maximum(*found)) return found;
  for (const int parameter : even_) near(parameter) = start_(parameter);
  inverse_.resize(0, 0);
  found = most_likely_near(likelihood_, most_likely_with(likelihood_, near, held_), held_,
                           inverse_);
  return found && is_maximum(*found) ? found : std::nullopt;
}

/// The likelihood is flat at 0 in a parameter in which it is even.
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
