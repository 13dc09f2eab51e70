#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "analysis/hierarchical/hierarchical_model.h"

namespace jnd::analysis {
namespace {

/// ln sum exp of the terms. Each term is replaced by its share of the sum.
double log_sum(std::vector<double>& terms) {
  const double largest = *std::ranges::max_element(terms);
  double sum = 0.0;
  for (const double term : terms) sum += std::exp(term - largest);
  for (double& term : terms) term = std::exp(term - largest) / sum;
  return largest + std::log(sum);
}

}  // namespace

double HierarchicalLikelihood::own_sum(const HierarchicalCell& cell,
                                       const Population& population, const Mode& mode,
                                       const Curvature& upper, const SharedNode& shared,
                                       std::size_t place, bool has_scores, Nodes& nodes) const {
  const OwnEffects& own = own_[static_cast<std::size_t>(cell.condition)];
  const std::size_t num_nodes = own.grid.node.size();
  const Eigen::Index num_shared = shared.effects.size() - first_shared_;
  nodes.own_shares.resize(num_nodes);
  nodes.own.resize(num_nodes);
  // The effects of a condition at a node are a middle, which follows from the shared effects,
  // plus the inverse root times the node. The condition's numbers are linear in them.
  Curvature inverse = Curvature::Identity(own.num, own.num);
  RandomEffects middle = RandomEffects::Zero(own.num);
  const CellLoadings loadings = loadings_in(cell.condition, population);
  Eigen::Matrix<double, kCellNumbers, 1> base =
      loadings.rightCols(num_shared) * shared.effects.tail(num_shared);
  if (own.num > 0) {
    const Curvature root = upper.block(own.first, own.first, own.num, own.num);
    root.triangularView<Eigen::Upper>().solveInPlace(inverse);
    middle = mode.at.segment(own.first, own.num);
    if (num_shared > 0) {
      middle -= inverse * (upper.block(own.first, first_shared_, own.num, num_shared) *
                           shared.away.tail(num_shared));
    }
  }
  const CellNumbers median = numbers_in(cell.condition, population.median);
  for (std::size_t m = 0; m < num_nodes; ++m) {
    const RandomEffects& node = own.grid.node[m];
    OwnNode& here = nodes.own[m];
    CellNumbers numbers{median.slope + base(0), median.place + base(1),
                        median.by_interval + base(2)};
    double height = own.heights[m];
    for (int effect = 0; effect < own.num; ++effect) {
      double at = middle(effect);
      for (int other = effect; other < own.num; ++other) {
        at += inverse(effect, other) * node(other);
      }
      here.effects[static_cast<std::size_t>(effect)] = at;
      height -= 0.5 * at * at;
      numbers.slope += loadings(0, own.first + effect) * at;
      numbers.place += loadings(1, own.first + effect) * at;
      numbers.by_interval += loadings(2, own.first + effect) * at;
    }
    nodes.own_shares[m] =
        height + log_likelihood(cell, numbers, population, has_scores ? &here.score : nullptr);
  }
  const double sum = log_sum(nodes.own_shares);
  if (!has_scores) return sum;

  // The mean over the nodes of each score, and of its products with the condition's own
  // effects.
  CellScore mean;
  std::array<std::array<double, kMostRandomEffects>, kCellNumbers> with_effects = {};
  for (std::size_t m = 0; m < num_nodes; ++m) {
    const double share = nodes.own_shares[m];
    const OwnNode& here = nodes.own[m];
    mean.lapse_rate += share * here.score.lapse_rate;
    mean.scatter += share * here.score.scatter;
    for (std::size_t number = 0; number < kCellNumbers; ++number) {
      const double score = share * here.score.numbers[number];
      mean.numbers[number] += score;
      for (std::size_t effect = 0; effect < static_cast<std::size_t>(own.num); ++effect) {
        with_effects[number][effect] += score * here.effects[effect];
      }
    }
  }
  auto by_parameter = nodes.by_parameter.col(static_cast<Eigen::Index>(place));
  by_parameter(cell.condition) += mean.numbers[0];
  if (structure_.has_places) {
    by_parameter(structure_.place_at(cell.condition)) += mean.numbers[1];
  }
  if (has_orders_) by_parameter(structure_.order_at(cell.condition)) += mean.numbers[2];
  for (const CellLoading& one : loadings_[static_cast<std::size_t>(cell.condition)]) {
    const int effect = one.random_effect - own.first;
    const bool is_own = effect >= 0 && effect < own.num;
    by_parameter(one.parameter) +=
        is_own ? with_effects[one.number][static_cast<std::size_t>(effect)]
               : mean.numbers[one.number] * shared.effects(one.random_effect);
  }
  nodes.by_lapse_rate[place] += mean.lapse_rate;
  nodes.by_scatter[place] += mean.scatter;
  return sum;
}

HierarchicalLikelihood::Integral HierarchicalLikelihood::integral_of(
    const HierarchicalPerson& person, const Population& population, const Mode& mode,
    bool has_scores, Nodes& nodes) const {
  const Eigen::LLT<Curvature> root(mode.information);
  const Curvature upper = root.matrixU();
  const Eigen::Index num_effects = mode.at.size();
  const Eigen::Index num_shared = num_effects - first_shared_;
  const std::size_t num_nodes = shared_grid_.node.size();
  nodes.shares.resize(num_nodes);
  if (has_scores) {
    nodes.by_parameter.setZero(structure_.num_parameters, static_cast<Eigen::Index>(num_nodes));
    nodes.by_lapse_rate.assign(num_nodes, 0.0);
    nodes.by_scatter.assign(num_nodes, 0.0);
  }
  for (std::size_t k = 0; k < num_nodes; ++k) {
    // The effects are solved from the last to the first, as in a triangular system.
    const RandomEffects& node = shared_grid_.node[k];
    SharedNode shared{mode.at, RandomEffects::Zero(num_effects)};
    double log_term = 0.0;
    if (num_shared > 0) {
      shared.away.tail(num_shared) = upper.bottomRightCorner(num_shared, num_shared)
                                         .triangularView<Eigen::Upper>()
                                         .solve(node);
      shared.effects.tail(num_shared) += shared.away.tail(num_shared);
      log_term = 0.5 * (node.squaredNorm() - shared.effects.tail(num_shared).squaredNorm()) +
                 std::log(shared_grid_.weight[k]);
    }
    for (const HierarchicalCell& cell : person) {
      log_term += own_sum(cell, population, mode, upper, shared, k, has_scores, nodes);
    }
    nodes.shares[k] = log_term;
  }
  Integral integral{.value = log_sum(nodes.shares) - upper.diagonal().array().log().sum()};
  if (!has_scores) return integral;
  const Eigen::Map<const Eigen::VectorXd> shares(nodes.shares.data(),
                                                 static_cast<Eigen::Index>(num_nodes));
  integral.by_parameter = nodes.by_parameter * shares;
  for (std::size_t k = 0; k < num_nodes; ++k) {
    integral.by_lapse_rate += nodes.shares[k] * nodes.by_lapse_rate[k];
    integral.by_scatter += nodes.shares[k] * nodes.by_scatter[k];
  }
  return integral;
}

}  // namespace jnd::analysis
