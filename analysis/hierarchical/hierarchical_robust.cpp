#include "analysis/hierarchical/hierarchical_robust.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/profile_crossing.h"

namespace jnd::analysis {
namespace {

/// A smaller correlation or lapse rate counts as none, because a search leaves about as much of
/// 0.
constexpr double kNoneAtAll = 1e-8;

/// The median person's Weber fraction in each condition.
std::vector<std::optional<double>> fractions_of(const HierarchicalStructure& structure,
                                                const HierarchicalOptimum& found) {
  std::vector<std::optional<double>> fractions;
  for (int condition = 0; condition < structure.num_conditions; ++condition) {
    fractions.push_back(found.status == FitStatus::kOk
                            ? fraction_at(structure.link, found.parameters(condition))
                            : std::nullopt);
  }
  return fractions;
}

Interval correlation_interval(const HierarchicalLikelihood& likelihood,
                              const HierarchicalStructure& structure,
                              const Eigen::VectorXd& start, const HierarchicalOptimum& found) {
  constexpr double kFirstStep = 0.05, kPrecision = 1e-5, kNoCurve = 1e3;
  constexpr double kMost = 0.5 * std::numbers::pi - 0.02;  // rho = 0.9996
  const int held = structure.scatter_at();
  std::vector<int> even = structure.even_parameters();
  std::erase(even, held);
  if (structure.has_lapses) even.push_back(structure.angle_at());
  const double at_best = std::fabs(found.parameters(held));
  const auto end = [&](double limit) -> std::optional<double> {
    HeldSearch search(likelihood, even, start, held);
    Eigen::VectorXd near = found.parameters;
    bool exists = true;
    const auto excess = [&](double angle) {
      near(held) = angle;
      const std::optional<Eigen::VectorXd> here = search.from(near);
      exists = here.has_value();
      if (!exists) return kNoCurve;
      near = *here;
      return found.log_likelihood - likelihood(*here) - kLikelihoodDrop;
    };
    const std::optional<double> angle =
        crossing(excess, at_best, kFirstStep, limit, kPrecision);
    if (!angle) return limit == 0.0 ? std::optional(0.0) : std::nullopt;
    (void)excess(*angle);
    return exists ? std::optional(std::pow(std::sin(*angle), 2)) : std::nullopt;
  };
  const bool is_at_bound = structure.correlation(found.parameters) < kNoneAtAll;
  return {is_at_bound ? std::optional(0.0) : end(0.0), end(kMost)};
}

}  // namespace

bool are_all_single(const HierarchicalArrangement& all) {
  return std::ranges::none_of(all.people, [](const HierarchicalPerson& person) {
    return std::ranges::any_of(person, [](const HierarchicalCell& cell) {
      for (std::size_t level = 0; level < cell.num_yes.size(); ++level) {
        if (cell.num_yes[level] + cell.num_no[level] > 1.0) return true;
      }
      return false;
    });
  });
}

HierarchicalScatter scatter_of(NestedOptima& nested, const HierarchicalLikelihood& likelihood,
                               const HierarchicalStructure& structure,
                               const Eigen::VectorXd& start, const HierarchicalOptimum& found,
                               bool has_interval) {
  HierarchicalScatter scatter{.correlation = structure.correlation(found.parameters)};
  if (scatter.correlation < kNoneAtAll) scatter.correlation = 0.0;
  const HierarchicalOptimum& without = nested.of(false, structure.has_own_lapses);
  if (without.status == FitStatus::kOk) {
    const HierarchicalStructure independent = nested.structure(false, structure.has_own_lapses);
    scatter.log_likelihood_without =
        without.log_likelihood - independent.log_prior(without.parameters);
    const BoundaryTest test = boundary_test(found.log_likelihood, without.log_likelihood);
    scatter.statistic = test.statistic;
    scatter.p_value = test.p_value;
    scatter.weber_fractions_without = fractions_of(independent, without);
  }
  if (has_interval) {
    scatter.correlation_ci95 = correlation_interval(likelihood, structure, start, found);
  }
  return scatter;
}

HierarchicalOwnLapses own_lapses_of(NestedOptima& nested,
                                    const HierarchicalStructure& structure,
                                    const HierarchicalOptimum& found) {
  constexpr double kNoSpreadOfAngles = 1e-6;
  HierarchicalOwnLapses own{.angle_sd = std::fabs(structure.lapse_spread(found.parameters)),
                            .mean_lapse_rate = structure.mean_lapse_rate(found.parameters)};
  if (own.angle_sd < kNoSpreadOfAngles) own.angle_sd = 0.0;
  if (own.mean_lapse_rate < kNoneAtAll) own.mean_lapse_rate = 0.0;
  const HierarchicalOptimum& common = nested.of(structure.has_scatter, false);
  if (common.status != FitStatus::kOk) return own;
  const HierarchicalStructure one_rate = nested.structure(structure.has_scatter, false);
  own.common_lapse_rate = one_rate.lapse_rate(common.parameters);
  if (*own.common_lapse_rate < kNoneAtAll) own.common_lapse_rate = 0.0;
  own.log_likelihood_common = common.log_likelihood - one_rate.log_prior(common.parameters);
  own.weber_fractions_common = fractions_of(one_rate, common);
  const BoundaryTest test = boundary_test(found.log_likelihood, common.log_likelihood);
  own.statistic = test.statistic;
  own.p_value = test.p_value;
  return own;
}

std::vector<HierarchicalPriorEffect> prior_effects(const HierarchicalArrangement& all,
                                                   const HierarchicalStructure& structure,
                                                   const HierarchicalOptimum& found,
                                                   int num_nodes) {
  std::vector<HierarchicalPriorEffect> effects;
  for (const double weight : kOtherPriorWeights) {
    HierarchicalStructure other = structure;
    other.lapse_prior = structure.lapse_prior.weighed(weight);
    const HierarchicalLikelihood likelihood(other, all.people, num_nodes);
    const HierarchicalOptimum moved = better_optimum(likelihood, other, found.parameters);
    HierarchicalPriorEffect effect{.weight = weight,
                                   .prior = other.lapse_prior,
                                   .weber_fractions = fractions_of(other, moved)};
    if (moved.status == FitStatus::kOk) {
      effect.lapse_rate = other.lapse_rate(moved.parameters);
      if (*effect.lapse_rate < kNoneAtAll) effect.lapse_rate = 0.0;
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

}  // namespace jnd::analysis
