#include "analysis/hierarchical/hierarchical_arrangement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/fits/interval_order_fit.h"
#include "analysis/fits/psychometric_model.h"
#include "core/error.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

template <typename Name>
std::size_t place_of(std::vector<Name>& names, const Name& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) names.push_back(name);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Removes about as many right answers as guesses explain. The result is only used as a start.
std::vector<AnswerCount> without_guesses(std::vector<AnswerCount> rows, double guess_rate) {
  for (AnswerCount& row : rows) {
    const auto n = static_cast<double>(row.num_trials), yes = static_cast<double>(row.num_yes);
    row.num_yes = std::llround(std::max(0.0, (yes - guess_rate * n) / (1.0 - guess_rate)));
  }
  return rows;
}

/// Two entries in a condition would count one person as two.
void require_first(const HierarchicalPerson& person, const HierarchicalCell& cell,
                   const ParticipantAnswers& answers) {
  if (std::ranges::find(person, cell.condition, &HierarchicalCell::condition) == person.end()) {
    return;
  }
  throw core::Error("answers: expected those of a participant in a condition together, found " +
                    answers.participant +
                    (answers.condition.empty() ? "" : " in " + answers.condition) + " twice");
}

/// Whether a person has answers in several conditions, so that the person's deviations there
/// may be correlated.
bool anybody_in_several(const HierarchicalArrangement& all) {
  return std::ranges::any_of(all.people, [](const HierarchicalPerson& person) {
    return std::ranges::any_of(person, [&](const HierarchicalCell& cell) {
      return cell.condition != person.front().condition;
    });
  });
}

/// Numbers the random effects so that those of a single condition come first, by condition; see
/// `HierarchicalLikelihood`.
void number_own_effects_first(HierarchicalStructure& structure) {
  const std::vector<int> conditions = structure.conditions_of_effects();
  std::vector<int> order(conditions.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int effect) {
    const int condition = conditions[static_cast<std::size_t>(effect)];
    return condition == HierarchicalStructure::kSeveral ? structure.num_conditions : condition;
  });
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  }
  for (HierarchicalStructure::Loading& one : structure.loadings) {
    one.random_effect = place[static_cast<std::size_t>(one.random_effect)];
  }
}

}  // namespace

HierarchicalArrangement arranged(const std::vector<ParticipantAnswers>& answers) {
  HierarchicalArrangement all;
  for (const ParticipantAnswers& one : answers) {
    std::map<double, std::vector<AnswerCount>> by_order;
    for (const AnswerCount& row : one.rows) by_order[row.order].push_back(row);
    HierarchicalCell cell;
    for (const auto& [order, rows] : by_order) {
      const PsychometricLevels levels = pooled_levels(rows, one.reference, false);
      all.yes_at_zero = all.yes_at_zero || levels.zero_yes > 0.0;
      for (std::size_t level = 0; level < levels.size(); ++level) {
        cell.log_ratio.push_back(levels.abscissa[level] * levels.unit);
        cell.num_yes.push_back(levels.num_yes[level]);
        cell.num_no.push_back(levels.num_trials[level] - levels.num_yes[level]);
        cell.order.push_back(order);
      }
    }
    if (cell.log_ratio.empty()) continue;
    const std::size_t condition = place_of(all.conditions, one.condition);
    const std::size_t person = place_of(all.participants, one.participant);
    all.reference.resize(all.conditions.size(), one.reference);
    all.pooled.resize(all.conditions.size());
    all.num_in_condition.resize(all.conditions.size());
    all.people.resize(all.participants.size());
    core::require(one.reference == all.reference[condition], "reference",
                  "the same for everybody in condition \"" + one.condition + "\"",
                  one.reference);
    all.has_orders_in.resize(all.conditions.size());
    if (orders_vary(one.rows)) all.has_orders_in[condition] = true;
    cell.condition = static_cast<int>(condition);
    require_first(all.people[person], cell, one);
    ++all.num_in_condition[condition];
    all.people[person].push_back(std::move(cell));
    all.pooled[condition].insert(all.pooled[condition].end(), one.rows.begin(), one.rows.end());
  }
  // A condition with a single order has no effect of the order.
  for (HierarchicalPerson& person : all.people) {
    for (HierarchicalCell& cell : person) {
      if (all.has_orders_in[static_cast<std::size_t>(cell.condition)]) continue;
      std::fill(cell.order.begin(), cell.order.end(), 0.0);
    }
  }
  return all;
}

/// If each condition has different people, one random effect of each kind is enough, because
/// the data cannot tell how effects of several conditions are correlated.
HierarchicalStructure structure_of(const HierarchicalArrangement& all,
                                   const HierarchicalOptions& options) {
  const std::vector<bool>& has_orders_in = all.has_orders_in;
  const bool are_within = anybody_in_several(all);
  const auto num_conditions = static_cast<int>(has_orders_in.size());
  HierarchicalStructure structure{.link = options.link,
                                  .num_conditions = num_conditions,
                                  .has_places = options.pse != HierarchicalPse::kReference,
                                  .has_orders_in = has_orders_in,
                                  .guess_rate = options.guess_rate};
  int parameter = structure.num_numbers();
  const bool correlated =
      options.slopes == HierarchicalSlopes::kCorrelated && num_conditions == 2;
  if (correlated && !are_within) {
    structure.loadings = {{0, 0, parameter}, {1, 0, parameter + 1}};
    parameter += 2;
  } else if (correlated) {
    structure.loadings = {{0, 0, parameter}, {1, 0, parameter + 1}, {1, 1, parameter + 2}};
    parameter += 3;
    structure.num_random_effects = 2;
  } else {
    for (int condition = 0; condition < num_conditions; ++condition) {
      structure.loadings.push_back({condition, 0, parameter});
    }
    parameter += 1;
  }
  // If either interval may hold the test, people differ in their bias for an interval. The loop
  // treats conditions without and with such orders as two kinds. A shared pse gives each person
  // one effect for each kind, and a personal pse one effect for each condition.
  for (const bool has_orders : {false, true}) {
    bool any = false;
    for (int condition = 0; condition < num_conditions; ++condition) {
      if (has_orders_in[static_cast<std::size_t>(condition)] != has_orders) continue;
      const bool personal = options.pse == HierarchicalPse::kPersonal ||
                            (has_orders && options.pse == HierarchicalPse::kReference);
      const bool shared = options.pse == HierarchicalPse::kShared;
      if (!personal && !shared) continue;
      structure.loadings.push_back(
          {structure.own_place_at(condition), structure.num_random_effects, parameter});
      any = true;
      if (personal) ++parameter;
      if (personal && are_within) ++structure.num_random_effects;
    }
    if (any && options.pse == HierarchicalPse::kShared) ++parameter;
    if (any && (options.pse == HierarchicalPse::kShared || !are_within)) {
      ++structure.num_random_effects;
    }
  }
  structure.has_own_lapses = options.lapses == HierarchicalLapses::kPersonal;
  structure.has_lapses =
      options.lapses == HierarchicalLapses::kCommon || structure.has_own_lapses;
  structure.lapse_prior = options.lapse_prior;
  structure.has_scatter = options.beta_binomial;
  if (options.lapses == HierarchicalLapses::kKnown) {
    structure.known_lapse_rate = options.lapse_rate;
  }
  structure.num_parameters = parameter + (structure.has_scatter ? 1 : 0) +
                             (structure.has_own_lapses ? 1 : 0) +
                             (structure.has_lapses ? 1 : 0);
  number_own_effects_first(structure);
  return structure;
}

std::optional<Eigen::VectorXd> start_of(const HierarchicalArrangement& all,
                                        const HierarchicalStructure& structure,
                                        std::string& reason) {
  constexpr double kSlopeSd = 0.2, kPlaceSd = 0.1, kLapseAngle = 0.15;
  constexpr double kLapseSpread = 0.1, kScatterAngle = 0.3;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(structure.num_parameters);
  if (structure.has_lapses) start(structure.angle_at()) = kLapseAngle;
  if (structure.has_own_lapses) start(structure.lapse_spread_at()) = kLapseSpread;
  if (structure.has_scatter) start(structure.scatter_at()) = kScatterAngle;
  for (int condition = 0; condition < structure.num_conditions; ++condition) {
    const auto at = static_cast<std::size_t>(condition);
    const auto fit = [&](const std::vector<AnswerCount>& rows) {
      return fit_psychometric(rows, {.reference = all.reference[at],
                                     .free_pse = structure.has_places,
                                     .by_order = true,
                                     .intervals = false,
                                     .solver = Solver::kNewton});
    };
    PsychometricFit pooled = fit(all.pooled[at]);
    if (structure.guess_rate > 0.0) {
      const PsychometricFit felt = fit(without_guesses(all.pooled[at], structure.guess_rate));
      if (felt.status == FitStatus::kOk) pooled = felt;
    }
    if (pooled.status != FitStatus::kOk) {
      const std::string& name = all.conditions[at];
      reason = (name.empty() ? "the pooled answers are " : name + ": the pooled answers are ") +
               pooled.reason;
      return std::nullopt;
    }
    const double slope = 1.0 / std::log1p(*pooled.weber_fraction);
    const double place = std::log(pooled.pse.value_or(all.reference[at]) / all.reference[at]);
    const bool linear = structure.link == HierarchicalLink::kLinear;
    start(condition) = linear ? slope : std::log(slope);
    const double scale = linear ? slope : 1.0;
    if (structure.has_places) {
      start(structure.place_at(condition)) = linear ? -slope * place : place;
    }
    if (structure.has_orders()) {
      start(structure.order_at(condition)) =
          (linear ? -slope : 1.0) * pooled.order_effect_ln.value_or(0.0);
    }
    for (const HierarchicalStructure::Loading& one : structure.loadings) {
      if (one.number == condition) start(one.parameter) = kSlopeSd * scale;
      if (one.number == structure.own_place_at(condition)) {
        start(one.parameter) = kPlaceSd * scale;
      }
    }
  }
  return start;
}

}  // namespace jnd::analysis
