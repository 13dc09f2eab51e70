#include "analysis/hierarchical/hierarchical_contrast.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace jnd::analysis {

std::optional<EffectEstimate> hierarchical_contrast(
    const HierarchicalFit& fit, HierarchicalLink link, HierarchicalNumber number,
    const std::map<std::string, double>& weights, const std::map<std::string, int>& groups,
    const std::map<int, int>& num_people) {
  if (link != HierarchicalLink::kLogSlope) {
    throw core::Error("contrast: expected a fit of logarithms of slopes, found a linear one");
  }
  if (fit.status != FitStatus::kOk) return std::nullopt;
  const auto num_conditions = static_cast<Eigen::Index>(fit.conditions.size());
  const bool of_pse = number == HierarchicalNumber::kLogPse;
  if (of_pse && fit.influence.rows() < 2 * num_conditions) return std::nullopt;
  Eigen::VectorXd by_number = Eigen::VectorXd::Zero(fit.influence.rows());
  double effect = 0.0;
  for (Eigen::Index at = 0; at < num_conditions; ++at) {
    const HierarchicalCondition& one = fit.conditions[static_cast<std::size_t>(at)];
    const auto weight = weights.find(one.condition);
    if (weight == weights.end() || weight->second == 0.0) continue;
    if (of_pse) {
      if (!one.pse || !std::isfinite(*one.pse) || !(*one.pse > 0.0)) return std::nullopt;
      effect += weight->second * one.place_number;
      by_number(num_conditions + at) = weight->second;
      continue;
    }
    if (!one.weber_fraction || !(*one.weber_fraction > 0.0)) return std::nullopt;
    // With a = -ln ln(1 + w), d ln w / da = -(1 + w) ln(1 + w) / w.
    const double w = *one.weber_fraction;
    effect += weight->second * std::log(w);
    by_number(at) = -weight->second * (1.0 + w) * std::log1p(w) / w;
  }
  std::map<int, double> squares;
  for (Eigen::Index person = 0; person < fit.influence.cols(); ++person) {
    const auto group = groups.find(fit.people[static_cast<std::size_t>(person)]);
    if (group == groups.end()) continue;
    squares[group->second] += std::pow(by_number.dot(fit.influence.col(person)), 2);
  }
  double variance = 0.0, by_freedom = 0.0;
  for (const auto& [group, sum] : squares) {
    const auto counted = num_people.find(group);
    const double n = counted == num_people.end() ? 0.0 : counted->second;
    if (n < 2.0) return std::nullopt;
    const double own = sum * n / (n - 1.0);
    variance += own;
    by_freedom += own * own / (n - 1.0);
  }
  constexpr double kRounding = 1e-24;
  if (!(variance > kRounding) || !(by_freedom > 0.0)) return std::nullopt;
  return EffectEstimate{effect, std::sqrt(variance), variance * variance / by_freedom};
}

}  // namespace jnd::analysis
