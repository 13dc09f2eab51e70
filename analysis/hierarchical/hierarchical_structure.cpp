#include "analysis/hierarchical/hierarchical_structure.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

/// The least share of random answers at which the prior is evaluated, because a prior may
/// exclude a share of 0.
constexpr double kLeastShare = 1e-12;

double squared_sine_of(double angle) noexcept {
  const double sine = std::sin(angle);
  return sine * sine;
}

/// The mean share of random answers over people.
double mean_share(double share, double spread) noexcept {
  const double away = -0.5 * std::expm1(-2.0 * spread * spread);
  return share + (1.0 - 2.0 * share) * away;
}

}  // namespace

std::vector<int> HierarchicalStructure::even_parameters() const {
  std::vector<int> even;
  for (const Loading& one : loadings) even.push_back(one.parameter);
  if (has_own_lapses) even.push_back(lapse_spread_at());
  if (has_scatter) even.push_back(scatter_at());
  return even;
}

double HierarchicalStructure::lapse_rate(const Eigen::VectorXd& parameters) const noexcept {
  if (!has_lapses) return known_lapse_rate;
  const double sine = std::sin(parameters(angle_at()));
  return lapse_limit() * sine * sine;
}

double HierarchicalStructure::mean_lapse_rate(
    const Eigen::VectorXd& parameters) const noexcept {
  if (!has_own_lapses) return lapse_rate(parameters);
  return lapse_limit() *
         mean_share(squared_sine_of(parameters(angle_at())), lapse_spread(parameters));
}

double HierarchicalStructure::correlation(const Eigen::VectorXd& parameters) const noexcept {
  return has_scatter ? squared_sine_of(parameters(scatter_at())) : 0.0;
}

double HierarchicalStructure::scatter(const Eigen::VectorXd& parameters) const noexcept {
  if (!has_scatter) return 0.0;
  const double tangent = std::tan(parameters(scatter_at()));
  return tangent * tangent;
}

double HierarchicalStructure::log_prior(const Eigen::VectorXd& parameters) const noexcept {
  if (!has_lapses) return 0.0;
  const double rate = mean_lapse_rate(parameters);
  const double value = (lapse_prior.b - 1.0) * std::log1p(-rate / lapse_limit());
  if (lapse_prior.a == 1.0) return value;
  return value + (lapse_prior.a - 1.0) * std::log(rate / lapse_limit() + kLeastShare);
}

double HierarchicalStructure::log_prior_rise(double lapse_rate,
                                             double lapse_spread) const noexcept {
  if (!has_lapses) return 0.0;
  const double limit = lapse_limit();
  if (!has_own_lapses && lapse_prior.a == 1.0) {
    return -(lapse_prior.b - 1.0) / (limit - lapse_rate);
  }
  const double share = mean_share(lapse_rate / limit, lapse_spread);
  const double by_mean =
      (lapse_prior.a - 1.0) / (share + kLeastShare) - (lapse_prior.b - 1.0) / (1.0 - share);
  return by_mean * std::exp(-2.0 * lapse_spread * lapse_spread) / limit;
}

void HierarchicalStructure::add_log_prior_rise(const Eigen::VectorXd& parameters,
                                               Eigen::VectorXd& gradient) const {
  if (!has_lapses) return;
  const double angle = parameters(angle_at());
  if (!has_own_lapses && lapse_prior.a == 1.0) {
    if (lapse_rate(parameters) > 0.0) {
      gradient(angle_at()) -= 2.0 * (lapse_prior.b - 1.0) * std::tan(angle);
    }
    return;
  }
  const double spread = lapse_spread(parameters);
  const double away = std::exp(-2.0 * spread * spread);
  const double share = mean_share(squared_sine_of(angle), spread);
  const double by_mean =
      (lapse_prior.a - 1.0) / (share + kLeastShare) - (lapse_prior.b - 1.0) / (1.0 - share);
  gradient(angle_at()) += by_mean * std::sin(2.0 * angle) * away;
  if (has_own_lapses) {
    gradient(lapse_spread_at()) += by_mean * 2.0 * spread * std::cos(2.0 * angle) * away;
  }
}

std::vector<int> HierarchicalStructure::conditions_of_effects() const {
  constexpr int kUnknown = -2;
  std::vector<int> conditions(static_cast<std::size_t>(num_random_effects), kUnknown);
  for (const Loading& one : loadings) {
    int& known = conditions[static_cast<std::size_t>(one.random_effect)];
    const int condition = condition_of(one.number);
    known = known == kUnknown || known == condition ? condition : kSeveral;
  }
  std::ranges::replace(conditions, kUnknown, kSeveral);
  return conditions;
}

}  // namespace jnd::analysis
