#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/hierarchical/hierarchical_model.h"

namespace jnd::analysis {
namespace {

/// ln sum exp of some terms, and each one's share of the sum in their place.
double log_sum(std::vector<double>& terms) {
  const double largest = *std::ranges::max_element(terms);
  double sum = 0.0;
  for (const double term : terms) sum += std::exp(term - largest);
  for (double& term : terms) term = std::exp(term - largest) / sum;
  return largest + std::log(sum);
}

}  // namespace

double HierarchicalLikelihood::log_integral(const HierarchicalPerson& person,
                                            const Population& population, const Mode& mode,
                                            const Curvature& upper,
                                            Eigen::VectorXd* score) const {
  const Eigen::Index num_effects = mode.at.size(), num_numbers = population.median.size();
  const Eigen::Index num_shared = num_effects - first_shared_;
  std::vector<double> shares(shared_grid_.node.size());
  std::vector<Eigen::VectorXd> scores(score != nullptr ? shares.size() : 0);
  std::vector<double> own_shares;
  std::vector<Score> own_scores;
  std::vector<RandomEffects> own_effects;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    // Node by node from the last effect to the first, as the triangle has them.
    RandomEffects effects = mode.at;
    RandomEffects away = RandomEffects::Zero(num_effects);
    const RandomEffects& shared_node = shared_grid_.node[k];
    if (num_shared > 0) {
      away.tail(num_shared) = upper.bottomRightCorner(num_shared, num_shared)
                                  .triangularView<Eigen::Upper>()
                                  .solve(shared_node);
      effects.tail(num_shared) += away.tail(num_shared);
    }
    double log_term =
        0.5 * (shared_node.squaredNorm() - effects.tail(num_shared).squaredNorm()) +
        std::log(shared_grid_.weight[k]);
    if (score != nullptr) scores[k] = Eigen::VectorXd::Zero(structure_.num_parameters + 1);
    for (const HierarchicalCell& cell : person) {
      const OwnEffects& own = own_[static_cast<std::size_t>(cell.condition)];
      const std::size_t num_nodes = own.grid.node.size();
      own_shares.resize(num_nodes);
      own_effects.assign(num_nodes, effects);
      own_scores.assign(score != nullptr ? num_nodes : 0,
                        Score{Numbers::Zero(num_numbers), 0.0});
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
          own_effects[m].segment(own.first, own.num) = own_part;
          log_prior = 0.5 * (node.squaredNorm() - own_part.squaredNorm());
        }
        own_shares[m] =
            log_likelihood(cell, population.at(own_effects[m]), population.lapse_rate,
                           score != nullptr ? &own_scores[m] : nullptr) +
            log_prior + std::log(own.grid.weight[m]);
      }
      log_term += log_sum(own_shares);
      if (score == nullptr) continue;
      Eigen::VectorXd& total = scores[k];
      for (std::size_t m = 0; m < num_nodes; ++m) {
        const Score& one = own_scores[m];
        total.head(num_numbers) += own_shares[m] * one.numbers;
        for (const HierarchicalStructure::Loading& loading : structure_.loadings) {
          if (structure_.condition_of(loading.number) != cell.condition) continue;
          total(loading.parameter) += own_shares[m] * one.numbers(loading.number) *
                                      own_effects[m](loading.random_effect);
        }
        total(structure_.num_parameters) += own_shares[m] * one.lapse_rate;
      }
    }
    shares[k] = log_term;
  }
  const double value = log_sum(shares);
  if (score != nullptr) {
    score->setZero(structure_.num_parameters + 1);
    for (std::size_t k = 0; k < shares.size(); ++k) *score += shares[k] * scores[k];
  }
  return value;
}

}  // namespace jnd::analysis
