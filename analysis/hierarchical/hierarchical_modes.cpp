#include "analysis/hierarchical/hierarchical_model.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/hierarchical/hierarchical_level.h"

namespace jnd::analysis {

// This file finds people's numbers at the mode, and handles people's own lapse rates.

HierarchicalLikelihood::Population HierarchicalLikelihood::population_at(
    const Population& population, const Eigen::VectorXd& parameters, double deviation) const {
  Population at = population;
  const double sine = std::sin(parameters(structure_.angle_at()) +
                               parameters(structure_.lapse_spread_at()) * deviation);
  at.lapse_rate = structure_.lapse_limit() * sine * sine;
  return at;
}

HierarchicalLikelihood::Integral HierarchicalLikelihood::own_lapses_integral(
    std::size_t person, const Population& population, const Eigen::VectorXd& parameters,
    bool has_scores, Nodes& nodes) const {
  // A term this far below the largest logarithm is lost in rounding.
  constexpr double kFarBelow = 40.0;
  const std::size_t num = lapse_nodes_.deviation.size();
  std::vector<Mode> modes(num);
  std::vector<double> heights(num);
  for (std::size_t k = 0; k < num; ++k) {
    const Population at = population_at(population, parameters, lapse_nodes_.deviation[k]);
    RandomEffects& last = last_[person * num + k];
    modes[k] = mode_of(people_[person], at, last);
    last = modes[k].at;
    heights[k] = log_likelihood(people_[person], at.at(last), at) - 0.5 * last.squaredNorm() +
                 std::log(lapse_nodes_.weight[k]);
  }
  const double highest = *std::ranges::max_element(heights);
  std::vector<Integral> integrals(num);
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < num; ++k) {
    if (!(heights[k] > highest - kFarBelow)) continue;
    const Population at = population_at(population, parameters, lapse_nodes_.deviation[k]);
    integrals[k] = integral_of(people_[person], at, modes[k], has_scores, nodes);
    integrals[k].value += std::log(lapse_nodes_.weight[k]);
    largest = std::max(largest, integrals[k].value);
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < num; ++k) {
    if (heights[k] > highest - kFarBelow) sum += std::exp(integrals[k].value - largest);
  }
  Integral all{.value = largest + std::log(sum)};
  if (!has_scores) return all;
  const int angle_at = structure_.angle_at(), spread_at = structure_.lapse_spread_at();
  all.by_parameter = Eigen::VectorXd::Zero(structure_.num_parameters);
  for (std::size_t k = 0; k < num; ++k) {
    if (!(heights[k] > highest - kFarBelow)) continue;
    const double share = std::exp(integrals[k].value - largest) / sum;
    const double deviation = lapse_nodes_.deviation[k];
    const double angle = parameters(angle_at) + parameters(spread_at) * deviation;
    const double by_angle =
        structure_.lapse_limit() * std::sin(2.0 * angle) * integrals[k].by_lapse_rate;
    all.by_parameter += share * integrals[k].by_parameter;
    all.by_parameter(angle_at) += share * by_angle;
    all.by_parameter(spread_at) += share * by_angle * deviation;
    all.by_scatter += share * integrals[k].by_scatter;
  }
  return all;
}

/// Takes the best node, and then searches between its neighbours by the golden section.
HierarchicalLikelihood::OwnMode HierarchicalLikelihood::own_mode_of(
    std::size_t person, const Population& population, const Eigen::VectorXd& parameters) const {
  const std::size_t num = lapse_nodes_.deviation.size();
  if (!structure_.has_own_lapses) {
    return {mode_of(people_[person], population, last_[person]), population.lapse_rate, 0.0};
  }
  OwnMode own;
  RandomEffects start = last_[person * num];
  const auto height = [&](double deviation) {
    const Population at = population_at(population, parameters, deviation);
    own.mode = mode_of(people_[person], at, start);
    own.lapse_rate = at.lapse_rate;
    start = own.mode.at;
    return log_likelihood(people_[person], at.at(start), at) - 0.5 * start.squaredNorm() -
           0.5 * deviation * deviation;
  };
  std::size_t best = 0;
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < num; ++k) {
    const double here = height(lapse_nodes_.deviation[k]);
    if (!(here > highest)) continue;
    highest = here;
    best = k;
  }
  constexpr double kGolden = 0.6180339887498949, kStep = 1e-2;
  constexpr int kNumSections = 40;
  const double step = lapse_nodes_.deviation[1] - lapse_nodes_.deviation[0];
  double low = lapse_nodes_.deviation[best] - step, high = low + 2.0 * step;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double at_left = height(left), at_right = height(right);
  for (int section = 0; section < kNumSections; ++section) {
    if (at_left > at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = height(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = height(right);
    }
  }
  const double middle = 0.5 * (low + high);
  const double beside = height(middle - kStep) + height(middle + kStep);
  const double information = (2.0 * height(middle) - beside) / (kStep * kStep);
  own.num_followed = std::clamp(1.0 - 1.0 / std::max(1.0, information), 0.0, 1.0);
  return own;
}

std::vector<Eigen::VectorXd> HierarchicalLikelihood::modes(
    const Eigen::VectorXd& parameters) const {
  const Population population = population_of(parameters);
  std::vector<Eigen::VectorXd> numbers;
  for (std::size_t person = 0; person < people_.size(); ++person) {
    const OwnMode own = own_mode_of(person, population, parameters);
    numbers.emplace_back(population.at(own.mode.at));
  }
  return numbers;
}

std::vector<double> HierarchicalLikelihood::lapse_rates(
    const Eigen::VectorXd& parameters) const {
  const Population population = population_of(parameters);
  std::vector<double> rates;
  for (std::size_t person = 0; person < people_.size(); ++person) {
    rates.push_back(own_mode_of(person, population, parameters).lapse_rate);
  }
  return rates;
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
    const OwnMode own = own_mode_of(person, population, parameters);
    const Curvature left =
        // How much of the prior's variance of 1 the answers have left.
        own.mode.information.inverse();
    num_followed += static_cast<double>(left.rows()) - left.trace();
    num_followed += own.num_followed;
    add_fitted(people_[person], population.at(own.mode.at), own.lapse_rate, answers);
  }
  return analysis::misfit_p_value(answers, num_followed);
}

}  // namespace jnd::analysis
