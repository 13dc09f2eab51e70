#include "analysis/hierarchical/hierarchical_model.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
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

/// A level's two probabilities, f of a yes and g of a no, as the likelihood needs them.
struct AnswerProbabilities {
  double log_yes, log_no;                    ///< ln f, ln g
  double by_z_yes, by_z_no;                  ///< d ln f / dz > 0, -d ln g / dz > 0
  double by_lapse_yes = 0, by_lapse_no = 0;  ///< d ln f / d lapse, d ln g / d lapse
};

/// `has_yes`, `has_no`: whether what belongs to such an answer is wanted; else it may be 0.
AnswerProbabilities answer_probabilities(double z, double lapse_rate, double guess_rate,
                                         bool has_yes = true, bool has_no = true) noexcept {
  if (lapse_rate == 0.0 && guess_rate == 0.0) {
    const LogNormalTails tails = log_normal_tails(z);
    return {tails.log_lower, tails.log_upper, tails.mills_lower, tails.mills_upper};
  }
  const NormalTails tails = normal_tails(z);
  if (guess_rate == 0.0) {
    const double share = 1.0 - 2.0 * lapse_rate;
    const double yes = lapse_rate + share * tails.lower, no = lapse_rate + share * tails.upper;
    const double by_z = share * tails.density, by_lapse = tails.upper - tails.lower;
    // Most levels far from the reference have answers of one kind, and logarithms are dear.
    AnswerProbabilities found{};
    if (has_yes) {
      found.log_yes = std::log(yes);
      found.by_z_yes = by_z / yes;
      found.by_lapse_yes = by_lapse / yes;
    }
    if (has_no) {
      found.log_no = std::log(no);
      found.by_z_no = by_z / no;
      found.by_lapse_no = -by_lapse / no;
    }
    return found;
  }
  const double share = 1.0 - guess_rate - lapse_rate;
  const double right = guess_rate + share * tails.lower;
  const double by_z = share * tails.density, by_lapse = -tails.lower;
  if (lapse_rate == 0.0) {  // A wrong answer may be as improbable as can be.
    const LogNormalTails logs = log_normal_tails(z);
    return {std::log(right), std::log(share) + logs.log_upper, by_z / right, logs.mills_upper};
  }
  const double wrong = lapse_rate + share * tails.upper;
  return {std::log(right), std::log(wrong),  by_z / right,
          by_z / wrong,    by_lapse / right, -by_lapse / wrong};
}

/// Of a share of attentive answers: its density is that to this.
constexpr double kPriorPower = 19.0;

/// One node of no dimension where there is none.
GaussHermiteGrid grid_of(int num_nodes, int num_dimensions) {
  if (num_dimensions > 0) return gauss_hermite_grid(num_nodes, num_dimensions);
  return {{RandomEffects(0)}, {1.0}};
}

}  // namespace

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

double HierarchicalStructure::lapse_rate(const Eigen::VectorXd& parameters) const noexcept {
  if (!has_lapses) return known_lapse_rate;
  const double sine = std::sin(parameters(angle_at()));
  return lapse_limit() * sine * sine;
}

double HierarchicalStructure::log_prior(const Eigen::VectorXd& parameters) const noexcept {
  return has_lapses ? kPriorPower * std::log1p(-lapse_rate(parameters) / lapse_limit()) : 0.0;
}

double HierarchicalStructure::log_prior_rise(double lapse_rate) const noexcept {
  return has_lapses ? -kPriorPower / (lapse_limit() - lapse_rate) : 0.0;
}

HierarchicalLikelihood::HierarchicalLikelihood(const HierarchicalStructure& structure,
                                               const std::vector<HierarchicalPerson>& people,
                                               int num_nodes)
    : structure_(structure),
      has_orders_(structure.has_orders()),
      people_(people),
      own_(static_cast<std::size_t>(structure.num_conditions)),
      is_laplace_(num_nodes == 1),
      last_(people.size(), RandomEffects::Zero(structure.num_random_effects)) {
  const std::vector<int> conditions = structure.conditions_of_effects();
  // Numbered as they have to be, or all in one sum.
  const auto shared = std::ranges::find(conditions, HierarchicalStructure::kSeveral);
  const bool is_ordered = std::ranges::is_sorted(conditions.begin(), shared) &&
                          std::all_of(shared, conditions.end(), [](int condition) {
                            return condition == HierarchicalStructure::kSeveral;
                          });
  first_shared_ = is_ordered ? static_cast<int>(shared - conditions.begin()) : 0;
  for (int effect = 0; effect < first_shared_; ++effect) {
    OwnEffects& own =
        own_[static_cast<std::size_t>(conditions[static_cast<std::size_t>(effect)])];
    if (own.num++ == 0) own.first = effect;
  }
  for (OwnEffects& own : own_) own.grid = grid_of(num_nodes, own.num);
  shared_grid_ = grid_of(num_nodes, structure.num_random_effects - first_shared_);
}

HierarchicalLikelihood::Population HierarchicalLikelihood::population_of(
    const Eigen::VectorXd& parameters) const {
  Population population{
      .median = parameters.head(structure_.num_numbers()),
      .loadings = Loadings::Zero(structure_.num_numbers(), structure_.num_random_effects),
      .lapse_rate = structure_.lapse_rate(parameters)};
  for (const HierarchicalStructure::Loading& one : structure_.loadings) {
    population.loadings(one.number, one.random_effect) = parameters(one.parameter);
  }
  return population;
}

double HierarchicalLikelihood::log_likelihood(const HierarchicalPerson& person,
                                              const Numbers& numbers,
                                              double lapse_rate) const noexcept {
  double value = 0.0;
  for (const HierarchicalCell& cell : person) {
    value += log_likelihood(cell, numbers, lapse_rate, nullptr);
  }
  return value;
}

double HierarchicalLikelihood::log_likelihood(const HierarchicalCell& cell,
                                              const Numbers& numbers, double lapse_rate,
                                              Score* score) const noexcept {
  double value = 0.0, by_lapse = 0.0;
  const int place_at = structure_.place_at(cell.condition);
  const int order_at = structure_.order_at(cell.condition);
  const double slope = slope_of(structure_.link, numbers(cell.condition));
  const double place = structure_.has_places ? numbers(place_at) : 0.0;
  const double by_interval = has_orders_ ? numbers(order_at) : 0.0;
  double by_slope = 0.0, by_place = 0.0, by_order = 0.0;
  for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
    const double order = has_orders_ ? cell.order[level] : 0.0;
    const Predictor at =
        predictor(structure_.link, slope, place + by_interval * order, cell.log_ratio[level]);
    const double yes = cell.num_yes[level], no = cell.num_no[level];
    const AnswerProbabilities answer =
        answer_probabilities(at.z, lapse_rate, structure_.guess_rate, yes > 0.0, no > 0.0);
    // A zero count contributes nothing, even where its logarithm is infinite.
    if (yes > 0.0) value += yes * answer.log_yes;
    if (no > 0.0) value += no * answer.log_no;
    const double by_z = yes * answer.by_z_yes - no * answer.by_z_no;
    by_lapse += yes * answer.by_lapse_yes + no * answer.by_lapse_no;
    by_slope += by_z * at.by_slope;
    by_place += by_z * at.by_place;
    by_order += by_z * at.by_place * order;
  }
  if (score == nullptr) return value;
  score->numbers(cell.condition) += by_slope;
  if (structure_.has_places) score->numbers(place_at) += by_place;
  if (has_orders_) score->numbers(order_at) += by_order;
  score->lapse_rate += by_lapse;
  return value;
}

HierarchicalLikelihood::JointDerivatives HierarchicalLikelihood::joint_derivatives(
    const HierarchicalPerson& person, const Population& population,
    const RandomEffects& at) const {
  const Numbers numbers = population.at(at);
  const Loadings& loadings = population.loadings;
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
      const AnswerProbabilities answer =
          answer_probabilities(here.z, population.lapse_rate, structure_.guess_rate);
      const double yes = cell.num_yes[level], no = cell.num_no[level];
      const double by_z = yes * answer.by_z_yes - no * answer.by_z_no;
      const RandomEffects by_effect = here.by_slope * slope_row + here.by_place * place_row;
      const Curvature outer = by_effect * by_effect.transpose();
      joint.gradient += by_z * by_effect;
      joint.expected += (yes + no) * answer.by_z_yes * answer.by_z_no * outer;
      joint.observed += (yes * answer.by_z_yes * (here.z + answer.by_z_yes) +
                         no * answer.by_z_no * (answer.by_z_no - here.z)) *
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
                                                             const Population& population,
                                                             const RandomEffects& start) const {
  constexpr int kMaxIterations = 200, kMaxHalvings = 40;
  constexpr double kSmallStep = 1e-12;
  const auto log_density = [&](const RandomEffects& at) {
    return log_likelihood(person, population.at(at), population.lapse_rate) -
           0.5 * at.squaredNorm();
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
  if (scores != nullptr) scores->setZero(structure_.num_parameters, num_people);
  Eigen::VectorXd values(num_people), score;
  for (std::size_t person = 0; person < people_.size(); ++person) {
    const Mode mode = mode_of(people_[person], population, last_[person]);
    last_[person] = mode.at;
    const Eigen::LLT<Curvature> root(mode.information);
    const Curvature upper = root.matrixU();
    const auto column = static_cast<Eigen::Index>(person);
    values(column) = log_integral(people_[person], population, mode, upper,
                                  scores != nullptr ? &score : nullptr) -
                     upper.diagonal().array().log().sum();
    if (scores == nullptr) continue;
    scores->col(column) = score.head(structure_.num_parameters);
    if (structure_.has_lapses && population.lapse_rate > 0.0) {
      (*scores)(structure_.angle_at(), column) =
          structure_.lapse_limit() * std::sin(2.0 * parameters(structure_.angle_at())) *
          score(structure_.num_parameters);
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
    if (structure_.has_lapses && structure_.lapse_rate(parameters) > 0.0) {
      const int angle_at = structure_.angle_at();
      (*gradient)(angle_at) -= 2.0 * kPriorPower * std::tan(parameters(angle_at));
    }
  }
  return total + structure_.log_prior(parameters);
}

std::vector<Eigen::VectorXd> HierarchicalLikelihood::modes(
    const Eigen::VectorXd& parameters) const {
  const Population population = population_of(parameters);
  std::vector<Eigen::VectorXd> numbers;
  for (std::size_t person = 0; person < people_.size(); ++person) {
    const Mode mode = mode_of(people_[person], population, last_[person]);
    numbers.emplace_back(population.at(mode.at));
  }
  return numbers;
}

void HierarchicalLikelihood::add_fitted(const HierarchicalPerson& person,
                                        const Numbers& numbers, double lapse_rate,
                                        std::vector<FittedAnswers>& answers) const {
  for (const HierarchicalCell& cell : person) {
    const double slope = slope_of(structure_.link, numbers(cell.condition));
    const double place =
        structure_.has_places ? numbers(structure_.place_at(cell.condition)) : 0.0;
    const double by_interval = has_orders_ ? numbers(structure_.order_at(cell.condition)) : 0.0;
    for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
      const double order = has_orders_ ? cell.order[level] : 0.0;
      const double z =
          predictor(structure_.link, slope, place + by_interval * order, cell.log_ratio[level])
              .z;
      const AnswerProbabilities answer =
          answer_probabilities(z, lapse_rate, structure_.guess_rate);
      answers.push_back({.num_yes = cell.num_yes[level],
                         .num_trials = cell.num_yes[level] + cell.num_no[level],
                         .probability = std::exp(answer.log_yes)});
    }
  }
}

std::optional<double> HierarchicalLikelihood::misfit_p_value(
    const Eigen::VectorXd& parameters) const {
  const Population population = population_of(parameters);
  std::vector<FittedAnswers> answers;
  double num_followed = 0.0;
  for (std::size_t person = 0; person < people_.size(); ++person) {
    const Mode mode = mode_of(people_[person], population, last_[person]);
    const Curvature left =
        mode.information.inverse();  // Of the prior's 1, what the answers left.
    num_followed += static_cast<double>(left.rows()) - left.trace();
    add_fitted(people_[person], population.at(mode.at), population.lapse_rate, answers);
  }
  return analysis::misfit_p_value(answers, num_followed);
}

}  // namespace jnd::analysis
