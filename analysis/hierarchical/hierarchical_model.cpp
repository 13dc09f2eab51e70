#include "analysis/hierarchical/hierarchical_model.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "analysis/hierarchical/hierarchical_level.h"

namespace jnd::analysis {
namespace {

/// A table costs some 1,300 probabilities. Below this number, as in a study of a dozen people,
/// they are computed directly.
constexpr double kManyProbabilities = 12'000.0;

using Totals = std::vector<std::pair<double, double>>;

/// For each person, the numbers of answers that levels have, and how many levels have each.
std::vector<Totals> totals_of(const std::vector<HierarchicalPerson>& people) {
  std::vector<Totals> totals;
  for (const HierarchicalPerson& person : people) {
    std::map<double, double> num_levels;
    for (const HierarchicalCell& cell : person) {
      for (std::size_t level = 0; level < cell.num_yes.size(); ++level) {
        num_levels[cell.num_yes[level] + cell.num_no[level]] += 1.0;
      }
    }
    totals.emplace_back(num_levels.begin(), num_levels.end());
  }
  return totals;
}

double most_answers(const std::vector<HierarchicalPerson>& people) {
  double most = 0.0;
  for (const Totals& person : totals_of(people)) {
    double num = 0.0;
    for (const auto& [num_answers, num_levels] : person) num += num_answers * num_levels;
    most = std::max(most, num);
  }
  return most;
}

/// If there is no dimension the grid has one node with no coordinates.
GaussHermiteGrid grid_of(int num_nodes, int num_dimensions) {
  if (num_dimensions > 0) return gauss_hermite_grid(num_nodes, num_dimensions);
  return {{RandomEffects(0)}, {1.0}};
}

}  // namespace

HierarchicalLikelihood::HierarchicalLikelihood(const HierarchicalStructure& structure,
                                               const std::vector<HierarchicalPerson>& people,
                                               int num_nodes)
    : structure_(structure),
      has_orders_(structure.has_orders()),
      people_(people),
      own_(static_cast<std::size_t>(structure.num_conditions)),
      loadings_(static_cast<std::size_t>(structure.num_conditions)),
      num_nodes_(num_nodes),
      lapse_nodes_(structure.has_own_lapses
                       ? lapse_nodes(most_answers(people), structure.lapse_limit())
                       : LapseNodes{{0.0}, {1.0}}),
      totals_(totals_of(people)),
      last_(people.size() * lapse_nodes_.deviation.size(),
            RandomEffects::Zero(structure.num_random_effects)) {
  const std::vector<int> conditions = structure.conditions_of_effects();
  // The effects must be numbered with the shared ones last. Otherwise all of them are in one
  // sum.
  const auto shared = std::ranges::find(conditions, HierarchicalStructure::kSeveral);
  const bool is_ordered = std::is_sorted(conditions.begin(), shared) &&
                          std::all_of(shared, conditions.end(), [](int condition) {
                            return condition == HierarchicalStructure::kSeveral;
                          });
  first_shared_ = is_ordered ? static_cast<int>(shared - conditions.begin()) : 0;
  for (int effect = 0; effect < first_shared_; ++effect) {
    const int condition = conditions[static_cast<std::size_t>(effect)];
    OwnEffects& own = own_[static_cast<std::size_t>(condition)];
    if (own.num++ == 0) own.first = effect;
  }
  for (OwnEffects& own : own_) {
    own.grid = grid_of(num_nodes, own.num);
    for (std::size_t k = 0; k < own.grid.node.size(); ++k) {
      own.heights.push_back(std::log(own.grid.weight[k]) +
                            0.5 * own.grid.node[k].squaredNorm());
    }
  }
  for (const HierarchicalStructure::Loading& one : structure.loadings) {
    const int condition = structure.condition_of(one.number);
    const std::size_t number = one.number == condition                                      ? 0
                               : has_orders_ && one.number == structure.order_at(condition) ? 2
                                                                                            : 1;
    loadings_[static_cast<std::size_t>(condition)].push_back(
        {number, one.random_effect, one.parameter});
  }
  shared_grid_ = grid_of(num_nodes, structure.num_random_effects - first_shared_);
  // With people's own lapse rates the rate differs at each node, so a table does not pay.
  has_table_ = !structure.has_own_lapses && num_probabilities() >= kManyProbabilities;
}

double HierarchicalLikelihood::num_probabilities() const {
  double num = 0.0;
  for (const HierarchicalPerson& person : people_) {
    for (const HierarchicalCell& cell : person) {
      const OwnEffects& own = own_[static_cast<std::size_t>(cell.condition)];
      num += static_cast<double>(cell.log_ratio.size() * own.grid.node.size() *
                                 shared_grid_.node.size());
    }
  }
  return num;
}

std::optional<HierarchicalLikelihood> HierarchicalLikelihood::coarser() const {
  constexpr int kCoarse = 5, kFine = 9;
  if (!has_table_ || num_nodes_ < kFine) return std::nullopt;
  return HierarchicalLikelihood(structure_, people_, kCoarse);
}

HierarchicalLikelihood::Population HierarchicalLikelihood::population_of(
    const Eigen::VectorXd& parameters) const {
  Population population{
      .median = parameters.head(structure_.num_numbers()),
      .loadings = Loadings::Zero(structure_.num_numbers(), structure_.num_random_effects),
      .lapse_rate = structure_.lapse_rate(parameters),
      .scatter = structure_.scatter(parameters)};
  for (const HierarchicalStructure::Loading& one : structure_.loadings) {
    population.loadings(one.number, one.random_effect) = parameters(one.parameter);
  }
  if (has_table_) {
    table_.set(population.lapse_rate, structure_.guess_rate);
    population.table = &table_;
  }
  return population;
}

HierarchicalLikelihood::Mode HierarchicalLikelihood::mode_of(const HierarchicalPerson& person,
                                                             const Population& population,
                                                             const RandomEffects& start) const {
  constexpr int kMaxIterations = 200, kMaxHalvings = 40;
  constexpr double kSmallStep = 1e-12;
  const auto log_density = [&](const RandomEffects& at) {
    return log_likelihood(person, population.at(at), population) - 0.5 * at.squaredNorm();
  };
  Mode mode{start, {}};
  double value = log_density(mode.at);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const JointDerivatives joint = joint_derivatives(person, population, mode.at);
    mode.information = joint.expected;
    // Newton's step if the density is log-concave, and otherwise Fisher's step, which always
    // leads uphill.
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

Eigen::VectorXd HierarchicalLikelihood::of_people(const Eigen::VectorXd& parameters,
                                                  Eigen::MatrixXd* scores) const {
  const bool is_known =
      last_parameters_.size() == parameters.size() && last_parameters_ == parameters;
  if (is_known && scores == nullptr) return last_values_;
  if (is_known && last_scores_.size() > 0) {
    *scores = last_scores_;
    return last_values_;
  }
  const Population population = population_of(parameters);
  const auto num_people = static_cast<Eigen::Index>(people_.size());
  const bool has_scores = scores != nullptr;
  if (has_scores) scores->setZero(structure_.num_parameters, num_people);
  Nodes nodes;
  Eigen::VectorXd values(num_people);
  for (std::size_t person = 0; person < people_.size(); ++person) {
    const auto column = static_cast<Eigen::Index>(person);
    Integral integral;
    if (structure_.has_own_lapses) {
      integral = own_lapses_integral(person, population, parameters, has_scores, nodes);
    } else {
      const Mode mode = mode_of(people_[person], population, last_[person]);
      last_[person] = mode.at;
      integral = integral_of(people_[person], population, mode, has_scores, nodes);
    }
    if (population.scatter > 0.0) {
      for (const auto& [num_answers, num_levels] : totals_[person]) {
        const ScatterTotal total = scatter_total(num_answers, population.scatter);
        integral.value -= num_levels * total.value;
        integral.by_scatter -= num_levels * total.by_scatter;
      }
    }
    values(column) = integral.value;
    if (!has_scores) continue;
    scores->col(column) = integral.by_parameter;
    if (structure_.has_lapses && !structure_.has_own_lapses && population.lapse_rate > 0.0) {
      (*scores)(structure_.angle_at(), column) =
          structure_.lapse_limit() * std::sin(2.0 * parameters(structure_.angle_at())) *
          integral.by_lapse_rate;
    }
    if (population.scatter > 0.0) {  // phi = tan^2 r
      (*scores)(structure_.scatter_at(), column) =
          integral.by_scatter * 2.0 * std::tan(parameters(structure_.scatter_at())) *
          (1.0 + population.scatter);
    }
  }
  last_parameters_ = parameters;
  last_values_ = values;
  last_scores_ = has_scores ? *scores : Eigen::MatrixXd();
  return values;
}

double HierarchicalLikelihood::operator()(const Eigen::VectorXd& parameters,
                                          Eigen::VectorXd* gradient) const {
  Eigen::MatrixXd scores;
  const double total = of_people(parameters, gradient != nullptr ? &scores : nullptr).sum();
  if (gradient != nullptr) {
    *gradient = scores.rowwise().sum();
    structure_.add_log_prior_rise(parameters, *gradient);
  }
  return total + structure_.log_prior(parameters);
}

}  // namespace jnd::analysis
