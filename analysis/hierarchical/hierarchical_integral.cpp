#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/hierarchical/hierarchical_model.h"

namespace jnd::analysis {
namespace {

/// ln sum exp of some terms, and each one's share of the sum in its place.
double log_sum(std::vector<double>& terms) {
  const double largest = *std::ranges::max_element(terms);
  double sum = 0.0;
  for (const double term : terms) sum += std::exp(term - largest);
  for (double& term : terms) term = std::exp(term - largest) / sum;
  return largest + std::log(sum);
}

}  // namespace

HierarchicalLikelihood::Integral HierarchicalLikelihood::integral_of(
    const HierarchicalPerson& person, const Population& population, const Mode& mode,
    bool has_scores, Nodes& nodes) const {
  const Eigen::LLT<Curvature> root(mode.information);
  const Curvature upper = root.matrixU();
  const Eigen::Index num_effects = mode.at.size(), num_numbers = population.median.size();
  const Eigen::Index num_shared = num_effects - first_shared_;
  nodes.shares.resize(shared_grid_.node.size());
  nodes.at_shared.resize(has_scores ? nodes.shares.size() : 0);
  for (std::size_t k = 0; k < nodes.shares.size(); ++k) {
    // From the last effects to the first, as a triangle is solved.
    const RandomEffects& shared_node = shared_grid_.node[k];
    RandomEffects effects = mode.at, away = RandomEffects::Zero(num_effects);
    double log_term = 0.0;
    if (num_shared > 0) {
      away.tail(num_shared) = upper.bottomRightCorner(num_shared, num_shared)
                                  .triangularView<Eigen::Upper>()
                                  .solve(shared_node);
      effects.tail(num_shared) += away.tail(num_shared);
      log_term = 0.5 * (shared_node.squaredNorm() - effects.tail(num_shared).squaredNorm()) +
                 std::log(shared_grid_.weight[k]);
    }
    if (has_scores) {
      nodes.at_shared[k] = {};
      nodes.at_shared[k].by_parameter = Eigen::VectorXd::Zero(structure_.num_parameters);
    }
    for (const HierarchicalCell& cell : person) {
      const OwnEffects& own = own_[static_cast<std::size_t>(cell.condition)];
      const std::size_t num_nodes = own.grid.node.size();
      nodes.own_shares.resize(num_nodes);
      nodes.own_effects.assign(num_nodes, effects);
      nodes.own_scores.assign(has_scores ? num_nodes : 0,
                              Score{.numbers = Numbers::Zero(num_numbers)});
      for (std::size_t m = 0; m < num_nodes; ++m) {
        double log_prior = 0.0;
        if (own.num > 0) {
          const RandomEffects& node = own.grid.node[m];
          RandomEffects pushed = node;
          if (num_shared > 0) {
            pushed -= upper.block(own.first, first_shared_, own.num, num_shared) *
                      away.tail(num_shared);
          }
          const RandomEffects own_part =
              mode.at.segment(own.first, own.num) +
              RandomEffects(upper.block(own.first, own.first, own.num, own.num)
                                .triangularView<Eigen::Upper>()
                                .solve(pushed));
          nodes.own_effects[m].segment(own.first, own.num) = own_part;
          log_prior = 0.5 * (node.squaredNorm() - own_part.squaredNorm());
        }
        nodes.own_shares[m] =
            log_likelihood(cell, population.at(nodes.own_effects[m]), population,
                           has_scores ? &nodes.own_scores[m] : nullptr) +
            log_prior + std::log(own.grid.weight[m]);
      }
      log_term += log_sum(nodes.own_shares);
      if (!has_scores) continue;
      Integral& total = nodes.at_shared[k];
      for (std::size_t m = 0; m < num_nodes; ++m) {
        const double share = nodes.own_shares[m];
        const Score& one = nodes.own_scores[m];
        total.by_parameter.head(num_numbers) += share * one.numbers;
        for (const HierarchicalStructure::Loading& loading : structure_.loadings) {
          if (structure_.condition_of(loading.number) != cell.condition) continue;
          total.by_parameter(loading.parameter) +=
              share * one.numbers(loading.number) * nodes.own_effects[m](loading.random_effect);
        }
        total.by_lapse_rate += share * one.lapse_rate;
        total.by_scatter += share * one.scatter;
      }
    }
    nodes.shares[k] = log_term;
  }
  Integral integral{.value = log_sum(nodes.shares) - upper.diagonal().array().log().sum()};
  if (!has_scores) return integral;
  integral.by_parameter = Eigen::VectorXd::Zero(structure_.num_parameters);
  for (std::size_t k = 0; k < nodes.shares.size(); ++k) {
    const Integral& one = nodes.at_shared[k];
    integral.by_parameter += nodes.shares[k] * one.by_parameter;
    integral.by_lapse_rate += nodes.shares[k] * one.by_lapse_rate;
    integral.by_scatter += nodes.shares[k] * one.by_scatter;
  }
  return integral;
}

}  // namespace jnd::analysis
