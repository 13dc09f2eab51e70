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

/// A table is some 1,300 probabilities itself; below this a study of a dozen people is
/// computed.
constexpr double kManyProbabilities = 12'000.0;

using Totals = std::vector<std::pair<double, double>>;

/// How many answers each level of each person has, and how many levels have as many.
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

/// One node of no dimension where there is none.
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
      is_laplace_(num_nodes == 1),
      lapse_nodes_(structure.has_own_lapses
                       ? lapse_nodes(most_answers(people), structure.lapse_limit())
                       : LapseNodes{{0.0}, {1.0}}),
      totals_(totals_of(people)),
      last_(people.size() * lapse_nodes_.deviation.size(),
            RandomEffects::Zero(structure.num_random_effects)) {
  const std::vector<int> conditions = structure.conditions_of_effects();
  // Numbered as they have to be, or all in one sum.
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
  for (OwnEffects& own : own_) own.grid = grid_of(num_nodes, own.num);
  shared_grid_ = grid_of(num_nodes, structure.num_random_effects - first_shared_);
  // Own lapse rates are another one at each node.
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

AnswerProbabilities HierarchicalLikelihood::answer_at(double z, const Population& population,
                                                      AnswersWanted wanted) const noexcept {
  if (population.table != nullptr) return population.table->at(z, wanted);
  return answer_probabilities(z, population.lapse_rate, structure_.guess_rate, wanted);
}

double HierarchicalLikelihood::log_likelihood(const HierarchicalPerson& person,
                                              const Numbers& numbers,
                                              const Population& population) const {
  double value = 0.0;
  for (const HierarchicalCell& cell : person) {
    value += log_likelihood(cell, numbers, population, nullptr);
  }
  return value;
}

double HierarchicalLikelihood::log_likelihood(const HierarchicalCell& cell,
                                              const Numbers& numbers,
                                              const Population& population,
                                              Score* score) const {
  const double scatter = population.scatter;
  const int place_at = structure_.place_at(cell.condition);
  const int order_at = structure_.order_at(cell.condition);
  const double slope = slope_of(structure_.link, numbers(cell.condition));
  const double place = structure_.has_places ? numbers(place_at) : 0.0;
  const double by_interval = has_orders_ ? numbers(order_at) : 0.0;
  double value = 0.0, by_lapse = 0.0, by_scatter = 0.0;
  double by_slope = 0.0, by_place = 0.0, by_order = 0.0;
  for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
    const double order = has_orders_ ? cell.order[level] : 0.0;
    const Predictor at =
        predictor(structure_.link, slope, place + by_interval * order, cell.log_ratio[level]);
    const double yes = cell.num_yes[level], no = cell.num_no[level];
    // A count of 0 asks for nothing.
    const AnswerProbabilities answer = answer_at(at.z, population,
                                                 {.of_yes = yes > 0.0,
                                                  .of_no = no > 0.0,
                                                  .by_z = score != nullptr,
                                                  .by_lapse = score != nullptr});
    if (scatter > 0.0 && score == nullptr) {
      value += scattered_value(yes, answer.log_yes, scatter) +
               scattered_value(no, answer.log_no, scatter);
      continue;
    }
    double by_z = 0.0;
    if (scatter > 0.0) {
      const ScatteredSide of_yes =
          scattered_side(yes, answer.log_yes, answer.by_z_yes, answer.by_lapse_yes, scatter);
      const ScatteredSide of_no =
          scattered_side(no, answer.log_no, answer.by_z_no, answer.by_lapse_no, scatter);
      value += of_yes.value + of_no.value;
      by_z = of_yes.by_z - of_no.by_z;
      by_lapse += of_yes.by_lapse + of_no.by_lapse;
      by_scatter += of_yes.by_scatter + of_no.by_scatter;
    } else {
      // A zero count contributes nothing, even where its logarithm is infinite.
      if (yes > 0.0) value += yes * answer.log_yes;
      if (no > 0.0) value += no * answer.log_no;
      by_z = yes * answer.by_z_yes - no * answer.by_z_no;
      by_lapse += yes * answer.by_lapse_yes + no * answer.by_lapse_no;
    }
    by_slope += by_z * at.by_slope;
    by_place += by_z * at.by_place;
    by_order += by_z * at.by_place * order;
  }
  if (score == nullptr) return value;
  score->numbers(cell.condition) += by_slope;
  if (structure_.has_places) score->numbers(place_at) += by_place;
  if (has_orders_) score->numbers(order_at) += by_order;
  score->lapse_rate += by_lapse;
  score->scatter += by_scatter;
  return value;
}

HierarchicalLikelihood::JointDerivatives HierarchicalLikelihood::joint_derivatives(
    const HierarchicalPerson& person, const Population& population,
    const RandomEffects& at) const {
  const Numbers numbers = population.at(at);
  const Loadings& loadings = population.loadings;
  const double scatter = population.scatter;
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
      if (has_orders_) {
        place += cell.order[level] * numbers(order_at);
        place_row += cell.order[level] * loadings.row(order_at).transpose();
      }
      const Predictor here = predictor(structure_.link, slope, place, cell.log_ratio[level]);
      const AnswerProbabilities answer = answer_at(here.z, population, {.by_lapse = false});
      const double yes = cell.num_yes[level], no = cell.num_no[level];
      double by_z = yes * answer.by_z_yes - no * answer.by_z_no;
      double expected = (yes + no) * answer.by_z_yes * answer.by_z_no;
      double observed = yes * answer.by_z_yes * (here.z + answer.by_z_yes) +
                        no * answer.by_z_no * (answer.by_z_no - here.z);
      if (scatter > 0.0) {
        const ScatteredSide of_yes =
            scattered_side(yes, answer.log_yes, answer.by_z_yes, 0.0, scatter);
        const ScatteredSide of_no =
            scattered_side(no, answer.log_no, answer.by_z_no, 0.0, scatter);
        by_z = of_yes.by_z - of_no.by_z;
        expected /= 1.0 + (yes + no - 1.0) * scatter / (1.0 + scatter);
        observed = of_yes.squares + of_no.squares + here.z * by_z;
      }
      const RandomEffects by_effect = here.by_slope * slope_row + here.by_place * place_row;
      const Curvature outer = by_effect * by_effect.transpose();
      joint.gradient += by_z * by_effect;
      joint.expected += expected * outer;
      joint.observed += observed * outer;
      if (structure_.link == HierarchicalLink::kLinear) continue;
      const Curvature mixed = slope_row * place_row.transpose();
      joint.observed -= by_z * (here.z * slope_row * slope_row.transpose() -
                                slope * (mixed + mixed.transpose()));
    }
  }
  return joint;
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

Eigen::VectorXd HierarchicalLikelihood::of_people(const Eigen::VectorXd& parameters,
                                                  Eigen::MatrixXd* scores) const {
  const bool is_known =
      last_parameters_.size() == parameters.size() && last_parameters_ == parameters;
  if (scores == nullptr && is_known) return last_values_;
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
