#include <vector>

#include "analysis/hierarchical/answer_table.h"
#include "analysis/hierarchical/hierarchical_level.h"
#include "analysis/hierarchical/hierarchical_model.h"

namespace jnd::analysis {

// This file computes what a person's answers in one condition add to the likelihood.

AnswerProbabilities HierarchicalLikelihood::answer_at(double z, const Population& population,
                                                      AnswersWanted wanted) const noexcept {
  if (population.table != nullptr) return population.table->at(z, wanted);
  return answer_probabilities(z, population.lapse_rate, structure_.guess_rate, wanted);
}

HierarchicalLikelihood::CellNumbers HierarchicalLikelihood::numbers_in(
    int condition, const Numbers& numbers) const noexcept {
  return {.slope = numbers(condition),
          .place = structure_.has_places ? numbers(structure_.place_at(condition)) : 0.0,
          .by_interval = has_orders_ ? numbers(structure_.order_at(condition)) : 0.0};
}

HierarchicalLikelihood::CellLoadings HierarchicalLikelihood::loadings_in(
    int condition, const Population& population) const {
  const Loadings& all = population.loadings;
  CellLoadings rows = CellLoadings::Zero(kCellNumbers, all.cols());
  rows.row(0) = all.row(condition);
  if (structure_.has_places) rows.row(1) = all.row(structure_.place_at(condition));
  if (has_orders_) rows.row(2) = all.row(structure_.order_at(condition));
  return rows;
}

double HierarchicalLikelihood::log_likelihood(const HierarchicalPerson& person,
                                              const Numbers& numbers,
                                              const Population& population) const {
  double value = 0.0;
  for (const HierarchicalCell& cell : person) {
    value += log_likelihood(cell, numbers_in(cell.condition, numbers), population, nullptr);
  }
  return value;
}

/// Handles one kind of answers at a time, with one look-up in the table for each level.
template <bool kHasScores>
double HierarchicalLikelihood::tabled_log_likelihood(const HierarchicalCell& cell,
                                                     const CellNumbers& numbers,
                                                     const AnswerTable& table,
                                                     CellScore* score) const noexcept {
  const bool is_linear = structure_.link == HierarchicalLink::kLinear;
  const double slope = slope_of(structure_.link, numbers.slope);
  double value = 0.0, by_lapse = 0.0;
  double by_slope = 0.0, by_z = 0.0, by_order = 0.0;
  const auto add = [&]<bool kIsNo>(const std::vector<double>& counts) {
    const std::size_t num_levels = counts.size();
    const double* const count_of = counts.data();
    const double* const log_ratio_of = cell.log_ratio.data();
    const double* const order_of = cell.order.data();
    for (std::size_t level = 0; level < num_levels; ++level) {
      const double count = count_of[level];
      if (!(count > 0.0)) continue;
      const double u = log_ratio_of[level];
      const double order = has_orders_ ? order_of[level] : 0.0;
      const double place = numbers.place + numbers.by_interval * order;
      const double z = is_linear ? slope * u + place : slope * (u - place);
      const AnswerTable::Side side = table.side<kHasScores>(kIsNo, z);
      value += count * side.log;
      if constexpr (kHasScores) {
        const double its_by_z = (kIsNo ? -count : count) * side.by_z;
        by_slope += its_by_z * (is_linear ? u : z);
        by_z += its_by_z;
        by_order += its_by_z * order;
        by_lapse += count * side.by_lapse;
      }
    }
  };
  add.template operator()<false>(cell.num_yes);
  add.template operator()<true>(cell.num_no);
  if constexpr (kHasScores) {
    const double by_place = is_linear ? 1.0 : -slope;
    *score = {{by_slope, by_place * by_z, by_place * by_order}, by_lapse, 0.0};
  }
  return value;
}

double HierarchicalLikelihood::log_likelihood(const HierarchicalCell& cell,
                                              const CellNumbers& numbers,
                                              const Population& population,
                                              CellScore* score) const noexcept {
  const double scatter = population.scatter;
  const bool has_scores = score != nullptr;
  if (population.table != nullptr && !(scatter > 0.0)) {
    return has_scores ? tabled_log_likelihood<true>(cell, numbers, *population.table, score)
                      : tabled_log_likelihood<false>(cell, numbers, *population.table, score);
  }
  const double slope = slope_of(structure_.link, numbers.slope);
  double value = 0.0, by_lapse = 0.0, by_scatter = 0.0;
  double by_slope = 0.0, by_place = 0.0, by_order = 0.0;
  for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
    const double order = has_orders_ ? cell.order[level] : 0.0;
    const Predictor at =
        predictor(structure_.link, slope, numbers.place + numbers.by_interval * order,
                  cell.log_ratio[level]);
    const double yes = cell.num_yes[level], no = cell.num_no[level];
    // A count of 0 needs no probability.
    const AnswerProbabilities answer =
        answer_at(at.z, population,
                  {.of_yes = yes > 0.0,
                   .of_no = no > 0.0,
                   .by_z = has_scores,
                   .by_lapse = has_scores && structure_.has_lapses});
    if (scatter > 0.0 && !has_scores) {
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
      // A count of 0 contributes nothing, even if its logarithm is infinite.
      if (yes > 0.0) value += yes * answer.log_yes;
      if (no > 0.0) value += no * answer.log_no;
      if (!has_scores) continue;
      by_z = yes * answer.by_z_yes - no * answer.by_z_no;
      by_lapse += yes * answer.by_lapse_yes + no * answer.by_lapse_no;
    }
    by_slope += by_z * at.by_slope;
    by_place += by_z * at.by_place;
    by_order += by_z * at.by_place * order;
  }
  if (has_scores) *score = {{by_slope, by_place, by_order}, by_lapse, by_scatter};
  return value;
}

HierarchicalLikelihood::JointDerivatives HierarchicalLikelihood::joint_derivatives(
    const HierarchicalPerson& person, const Population& population,
    const RandomEffects& at) const {
  using ByNumbers = Eigen::Matrix<double, kCellNumbers, 1>;
  using Curvatures = Eigen::Matrix<double, kCellNumbers, kCellNumbers>;
  const Numbers numbers = population.at(at);
  const double scatter = population.scatter;
  const Curvature prior = Curvature::Identity(at.size(), at.size());
  JointDerivatives joint{-at, prior, prior};
  for (const HierarchicalCell& cell : person) {
    // The derivatives are taken by a, p and q first. The way from these to the random effects
    // is the same at every level.
    const CellNumbers own = numbers_in(cell.condition, numbers);
    const double slope = slope_of(structure_.link, own.slope);
    ByNumbers gradient = ByNumbers::Zero();
    Curvatures expected = Curvatures::Zero(), observed = Curvatures::Zero();
    for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
      const double order = has_orders_ ? cell.order[level] : 0.0;
      const Predictor here = predictor(
          structure_.link, slope, own.place + own.by_interval * order, cell.log_ratio[level]);
      const AnswerProbabilities answer = answer_at(here.z, population, {.by_lapse = false});
      const double yes = cell.num_yes[level], no = cell.num_no[level];
      double by_z = yes * answer.by_z_yes - no * answer.by_z_no;
      double in_expected = (yes + no) * answer.by_z_yes * answer.by_z_no;
      double in_observed = yes * answer.by_z_yes * (here.z + answer.by_z_yes) +
                           no * answer.by_z_no * (answer.by_z_no - here.z);
      if (scatter > 0.0) {
        const ScatteredSide of_yes =
            scattered_side(yes, answer.log_yes, answer.by_z_yes, 0.0, scatter);
        const ScatteredSide of_no =
            scattered_side(no, answer.log_no, answer.by_z_no, 0.0, scatter);
        by_z = of_yes.by_z - of_no.by_z;
        in_expected /= 1.0 + (yes + no - 1.0) * scatter / (1.0 + scatter);
        in_observed = of_yes.squares + of_no.squares + here.z * by_z;
      }
      const ByNumbers by_number(here.by_slope, here.by_place, here.by_place * order);
      const Curvatures outer = by_number * by_number.transpose();
      gradient += by_z * by_number;
      expected += in_expected * outer;
      observed += in_observed * outer;
      if (structure_.link == HierarchicalLink::kLinear) continue;
      // z = e^a (u - p - q o) has second derivatives by a, and by a together with p or q.
      const double by_both = by_z * slope;
      observed(0, 0) -= by_z * here.z;
      observed(0, 1) += by_both;
      observed(1, 0) += by_both;
      observed(0, 2) += by_both * order;
      observed(2, 0) += by_both * order;
    }
    const CellLoadings loadings = loadings_in(cell.condition, population);
    joint.gradient += loadings.transpose() * gradient;
    joint.expected += loadings.transpose() * expected * loadings;
    joint.observed += loadings.transpose() * observed * loadings;
  }
  return joint;
}

}  // namespace jnd::analysis
