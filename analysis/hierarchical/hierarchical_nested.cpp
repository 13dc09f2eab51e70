#include "analysis/hierarchical/hierarchical_nested.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/distributions.h"

namespace jnd::analysis {
namespace {

Eigen::VectorXd with_one_more(const Eigen::VectorXd& all, Eigen::Index at, double value) {
  Eigen::VectorXd more(all.size() + 1);
  more << all.head(at), value, all.tail(all.size() - at);
  return more;
}

Eigen::VectorXd with_one_less(const Eigen::VectorXd& all, Eigen::Index at) {
  Eigen::VectorXd less(all.size() - 1);
  less << all.head(at), all.tail(all.size() - 1 - at);
  return less;
}

}  // namespace

BoundaryTest boundary_test(double log_with, double log_without) {
  constexpr double kNoGain = 1e-7;  // A search may leave this much of a gain of 0.
  const double statistic = 2.0 * (log_with - log_without);
  if (!(statistic > kNoGain)) return {};
  return {statistic, 0.5 * chi_squared_above(statistic, 1.0)};
}

NestedOptima::NestedOptima(const std::vector<HierarchicalPerson>& people,
                           HierarchicalStructure structure, Eigen::VectorXd start,
                           int num_nodes)
    : people_(people),
      structure_(std::move(structure)),
      start_(std::move(start)),
      num_nodes_(num_nodes) {}

HierarchicalStructure NestedOptima::structure(bool has_scatter, bool has_own_lapses) const {
  HierarchicalStructure within = structure_;
  within.num_parameters -= (structure_.has_scatter && !has_scatter ? 1 : 0) +
                           (structure_.has_own_lapses && !has_own_lapses ? 1 : 0);
  within.has_scatter = has_scatter;
  within.has_own_lapses = has_own_lapses;
  return within;
}

const HierarchicalOptimum& NestedOptima::of(bool has_scatter, bool has_own_lapses) {
  const std::pair model{has_scatter, has_own_lapses};
  const auto known = found_.find(model);
  if (known != found_.end()) return known->second;
  return found_[model] = sought(has_scatter, has_own_lapses);
}

HierarchicalOptimum NestedOptima::sought(bool has_scatter, bool has_own_lapses) {
  constexpr double kAngle = 0.25, kSpread = 0.25, kNearlyNoLapses = 0.02;
  const HierarchicalStructure model = structure(has_scatter, has_own_lapses);
  Eigen::VectorXd start = start_;
  if (structure_.has_own_lapses && !has_own_lapses) {
    start = with_one_less(start, structure_.lapse_spread_at());
  }
  if (structure_.has_scatter && !has_scatter) {
    start = with_one_less(start, structure_.scatter_at());
  }
  const HierarchicalLikelihood likelihood(model, people_, num_nodes_);
  HierarchicalOptimum best;
  const auto search = [&](const Eigen::VectorXd& from) {
    HierarchicalOptimum other = most_likely(likelihood, from);
    // If most people have no lapses the likelihood is nearly flat in v near 0, and Newton's
    // method creeps. The search is repeated from v = 0, which it does not leave.
    if (has_own_lapses && other.status == FitStatus::kNotConverged &&
        std::fabs(other.parameters(model.angle_at())) < kNearlyNoLapses) {
      Eigen::VectorXd at = other.parameters;
      at(model.angle_at()) = 0.0;
      other = most_likely(likelihood, at);
    }
    const bool is_better =
        best.status != FitStatus::kOk ||
        (other.status == FitStatus::kOk && other.log_likelihood > best.log_likelihood);
    if (is_better) best = std::move(other);
  };
  const auto search_from = [&](const HierarchicalOptimum& within, int at, double value,
                               bool is_of_one_person) {
    if (within.status != FitStatus::kOk) return;
    Eigen::VectorXd from = with_one_more(within.parameters, at, value);
    if (is_of_one_person) {
      from(model.angle_at()) = 0.0;
      for (const HierarchicalStructure::Loading& one : model.loadings) {
        from(one.parameter) = start(one.parameter);
      }
    }
    search(from);
  };
  const auto is_below = [&](const HierarchicalOptimum& within) {
    return within.status == FitStatus::kOk &&
           (best.status != FitStatus::kOk || best.log_likelihood < within.log_likelihood);
  };
  if (!has_own_lapses) {
    best = better_optimum(likelihood, model, start);
  } else {
    // With a common lapse rate a person who lapses seems to have a flat curve, and people's
    // slopes seem to differ more than they do. The second search therefore starts from an angle
    // v of 0 and from the spreads of `start`.
    const HierarchicalOptimum& common = of(has_scatter, false);
    search_from(common, model.lapse_spread_at(), kSpread, false);
    search_from(common, model.lapse_spread_at(), kSpread, true);
    if (best.status != FitStatus::kOk) search(start);
    if (is_below(common)) search_from(common, model.lapse_spread_at(), 0.0, false);
  }
  if (!has_scatter) return best;
  const HierarchicalOptimum& independent = of(false, has_own_lapses);
  search_from(independent, model.scatter_at(), kAngle, false);
  if (is_below(independent)) search_from(independent, model.scatter_at(), 0.0, false);
  return best;
}

}  // namespace jnd::analysis
