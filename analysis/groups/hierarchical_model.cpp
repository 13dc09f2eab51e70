#include "analysis/groups/hierarchical_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/fits/normal_tail.h"

namespace jnd::analysis {
namespace {

/// z at one level and its derivatives in a and p.
struct Predictor {
  double z, by_slope, by_place;
};

Predictor predictor(HierarchicalLink link, double slope, double place, double u) noexcept {
  if (link == HierarchicalLink::kLinear) return {slope * u + place, u, 1.0};
  const double z = slope * (u - place);  // `slope` is e^a.
  return {z, z, -slope};
}

double slope_of(HierarchicalLink link, double number) noexcept {
  return link == HierarchicalLink::kLinear ? number : std::exp(number);
}

}  // namespace

HierarchicalLikelihood::HierarchicalLikelihood(const HierarchicalStructure& structure,
                                               const std::vector<HierarchicalPerson>& people,
                                               int num_nodes)
    : structure_(structure),
      people_(people),
      grid_(gauss_hermite_grid(num_nodes, structure.num_random_effects)),
      last_(people.size(), RandomEffects::Zero(structure.num_random_effects)) {}

HierarchicalLikelihood::Loadings HierarchicalLikelihood::loadings_of(
    const Eigen::VectorXd& parameters) const {
  Loadings loadings = Loadings::Zero(structure_.num_numbers(), structure_.num_random_effects);
  for (const HierarchicalStructure::Loading& one : structure_.loadings) {
    loadings(one.number, one.random_effect) = parameters(one.parameter);
  }
  return loadings;
}

double HierarchicalLikelihood::log_likelihood(const HierarchicalPerson& person,
                                              const Numbers& numbers,
                                              Numbers* score) const noexcept {
  double value = 0.0;
  for (const HierarchicalCell& cell : person) {
    const int place_at = structure_.place_at(cell.condition);
    const int order_at = structure_.order_at(cell.condition);
    const double slope = slope_of(structure_.link, numbers(cell.condition));
    const double place = structure_.has_places ? numbers(place_at) : 0.0;
    const double by_interval = structure_.has_orders ? numbers(order_at) : 0.0;
    double by_slope = 0.0, by_place = 0.0, by_order = 0.0;
    for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
      const double order = structure_.has_orders ? cell.order[level] : 0.0;
      const Predictor at =
          predictor(structure_.link, slope, place + by_interval * order, cell.log_ratio[level]);
      const LogNormalTails tails = log_normal_tails(at.z);
      const double yes = cell.num_yes[level], no = cell.num_no[level];
      // A zero count contributes nothing, even where its logarithm is infinite.
      if (yes > 0.0) value += yes * tails.log_lower;
      if (no > 0.0) value += no * tails.log_upper;
      const double by_z = yes * tails.mills_lower - no * tails.mills_upper;
      by_slope += by_z * at.by_slope;
      by_place += by_z * at.by_place;
      by_order += by_z * at.by_place * order;
    }
    if (score == nullptr) continue;
    (*score)(cell.condition) += by_slope;
    if (structure_.has_places) (*score)(place_at) += by_place;
    if (structure_.has_orders) (*score)(order_at) += by_order;
  }
  return value;
}

HierarchicalLikelihood::JointDerivatives HierarchicalLikelihood::joint_derivatives(
    const HierarchicalPerson& person, const Numbers& median, const Loadings& loadings,
    const RandomEffects& at) const {
  const Numbers numbers = median + loadings * at;
  const Curvature prior = Curvature::Identity(at.size(), at.size());
  JointDerivatives joint{-at, prior, prior};
  for (const HierarchicalCell& cell : person) {
    const int place_at = structure_.place_at(cell.condition);
    const int order_at = structure_.order_at(cell.condition);
    const double slope = slope_of(structure_.link, numbers(cell.condition));
    const RandomEffects slope_row = loadings.row(cell.condition).transpose();
    for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
      double place = 0.0;
      RandomEffects place_row = RandomEffects::Zero(at.size());
      if (structure_.has_places) {
        place = numbers(place_at);
        place_row = loadings.row(place_at).transpose();
      }
      if (structure_.has_orders) {
        place += cell.order[level] * numbers(order_at);
        place_row += cell.order[level] * loadings.row(order_at).transpose();
      }
      const Predictor here = predictor(structure_.link, slope, place, cell.log_ratio[level]);
      const LogNormalTails tails = log_normal_tails(here.z);
      const double yes = cell.num_yes[level], no = cell.num_no[level];
      const double by_z = yes * tails.mills_lower - no * tails.mills_upper;
      const RandomEffects by_effect = here.by_slope * slope_row + here.by_place * place_row;
      const Curvature outer = by_effect * by_effect.transpose();
      joint.gradient += by_z * by_effect;
      joint.expected += (yes + no) * tails.mills_lower * tails.mills_upper * outer;
      joint.observed += (yes * tails.mills_lower * (here.z + tails.mills_lower) +
                         no * tails.mills_upper * (tails.mills_upper - here.z)) *
                        outer;
      if (structure_.link == HierarchicalLink::kLinear) continue;
      const Curvature mixed = slope_row * place_row.transpose();
      joint.observed -= by_z * (here.z * slope_row * slope_row.transpose() -
                                slope * (mixed + mixed.transpose()));
    }
  }
  return joint;
}

HierarchicalLikelihood::Mode HierarchicalLikelihood::mode_of(const HierarchicalPerson& person,
                                                             const Numbers& median,
                                                             const Loadings& loadings,
                                                             const RandomEffects& start) const {
  constexpr int kMaxIterations = 200, kMaxHalvings = 40;
  constexpr double kSmallStep = 1e-12;
  const auto log_density = [&](const RandomEffects& at) {
    return log_likelihood(person, median + loadings * at, nullptr) - 0.5 * at.squaredNorm();
  };
  Mode mode{start, {}};
  double value = log_density(mode.at);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const JointDerivatives joint = joint_derivatives(person, median, loadings, mode.at);
    mode.information = joint.expected;
    // Newton's step where the density is log-concave, else Fisher's, which always rises.
    const Eigen::LLT<Curvature> newton(joint.observed);
    RandomEffects step = newton.info() == Eigen::Success
                             ? RandomEffects(newton.solve(joint.gradient))
                             : RandomEffects(joint.expected.llt().solve(joint.gradient));
    if (!(step.norm() > kSmallStep)) return mode;
    const double least = value - 1e-13 * std::fabs(value) - 1e-15;
    double next = log_density(mode.at + step);
    for (int halving = 0; !(next >= least) && halving < kMaxHalvings; ++halving) {
      step *= 0.5;
      next = log_density(mode.at + step);
    }
    if (!(next >= least)) return mode;  // Rounding hides what is left to gain.
    mode.at += step;
    value = next;
  }
  return mode;
}

double HierarchicalLikelihood::operator()(const Eigen::VectorXd& parameters,
                                          Eigen::VectorXd* gradient) const {
  const Numbers median = parameters.head(structure_.num_numbers());
  const Loadings loadings = loadings_of(parameters);
  if (gradient != nullptr) gradient->setZero(structure_.num_parameters);
  std::vector<double> log_term(grid_.node.size());
  std::vector<RandomEffects> effects(grid_.node.size());
  std::vector<Numbers> score(grid_.node.size());
  double total = 0.0;
  for (std::size_t person = 0; person < people_.size(); ++person) {
    const Mode mode = mode_of(people_[person], median, loadings, last_[person]);
    last_[person] = mode.at;
    const Eigen::LLT<Curvature> root(mode.information);
    const Curvature lower = root.matrixL();
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < grid_.node.size(); ++k) {
      effects[k] = mode.at + RandomEffects(root.matrixU().solve(grid_.node[k]));
      score[k] = Numbers::Zero(structure_.num_numbers());
      log_term[k] = log_likelihood(people_[person], median + loadings * effects[k],
                                   gradient != nullptr ? &score[k] : nullptr) +
                    0.5 * (grid_.node[k].squaredNorm() - effects[k].squaredNorm()) +
                    std::log(grid_.weight[k]);
      largest = std::max(largest, log_term[k]);
    }
    double sum = 0.0;
    for (const double term : log_term) sum += std::exp(term - largest);
    total += largest + std::log(sum) - lower.diagonal().array().log().sum();
    if (gradient == nullptr) continue;
    for (std::size_t k = 0; k < grid_.node.size(); ++k) {
      const double share = std::exp(log_term[k] - largest) / sum;
      for (int number = 0; number < structure_.num_numbers(); ++number) {
        (*gradient)(number) += share * score[k](number);
      }
      for (const HierarchicalStructure::Loading& one : structure_.loadings) {
        (*gradient)(one.parameter) +=
            share * score[k](one.number) * effects[k](one.random_effect);
      }
    }
  }
  return total;
}

std::vector<Eigen::VectorXd> HierarchicalLikelihood::modes(
    const Eigen::VectorXd& parameters) const {
  const Numbers median = parameters.head(structure_.num_numbers());
  const Loadings loadings = loadings_of(parameters);
  std::vector<Eigen::VectorXd> numbers;
  for (std::size_t person = 0; person < people_.size(); ++person) {
    const Mode mode = mode_of(people_[person], median, loadings, last_[person]);
    numbers.emplace_back(median + loadings * mode.at);
  }
  return numbers;
}

}  // namespace jnd::analysis
