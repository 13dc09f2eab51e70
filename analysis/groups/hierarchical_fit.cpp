#include "analysis/groups/hierarchical_fit.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>

#include "analysis/fits/interval_order_fit.h"
#include "analysis/fits/psychometric_model.h"
#include "analysis/groups/hierarchical_search.h"
#include "analysis/groups/hierarchical_words.h"
#include "core/error.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// A spread between people that is less is none.
constexpr double kNoSpread = 1e-6;

/// The answers as the model takes them.
struct Arranged {
  std::vector<std::string> conditions;  ///< In the order of their first answers.
  std::vector<double> reference;        ///< Of each condition.
  std::vector<std::string> participants;
  std::vector<HierarchicalPerson> people;
  std::vector<std::vector<AnswerCount>> pooled;  ///< Rows of each condition.
  std::vector<int> num_in_condition;
  bool yes_at_zero = false;
  std::vector<bool> has_orders_in;  ///< Of each condition: rows differ in the order.
};

template <typename Name>
std::size_t place_of(std::vector<Name>& names, const Name& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) names.push_back(name);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Arranged arranged(const std::vector<ParticipantAnswers>& answers) {
  Arranged all;
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
    ++all.num_in_condition[condition];
    all.people[person].push_back(std::move(cell));
    all.pooled[condition].insert(all.pooled[condition].end(), one.rows.begin(), one.rows.end());
  }
  // One order alone is none.
  for (HierarchicalPerson& person : all.people) {
    for (HierarchicalCell& cell : person) {
      if (all.has_orders_in[static_cast<std::size_t>(cell.condition)]) continue;
      std::fill(cell.order.begin(), cell.order.end(), 0.0);
    }
  }
  return all;
}

/// Somebody has answers in several conditions, so that what is their own there may go together.
bool anybody_in_several(const Arranged& all) {
  return std::ranges::any_of(all.people, [](const HierarchicalPerson& person) {
    return std::ranges::any_of(person, [&](const HierarchicalCell& cell) {
      return cell.condition != person.front().condition;
    });
  });
}

/// Of other people in each condition, one random effect of a kind is enough: nothing could tell
/// how several go together.
HierarchicalStructure structure_of(const std::vector<bool>& has_orders_in, bool are_within,
                                   const HierarchicalOptions& options) {
  const auto num_conditions = static_cast<int>(has_orders_in.size());
  HierarchicalStructure structure{.link = options.link,
                                  .num_conditions = num_conditions,
                                  .has_places = options.pse != HierarchicalPse::kReference,
                                  .has_orders_in = has_orders_in};
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
  // With either interval, what is a person's own is the bias for one of them: one of each kind
  // a person where it is shared, one a condition where it is personal.
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
  structure.has_lapses = options.lapses == HierarchicalLapses::kCommon;
  structure.num_parameters = parameter + (structure.has_lapses ? 1 : 0);
  return structure;
}

int usual_num_nodes(int num_random_effects) {
  constexpr int kNodes[] = {15, 9, 5, 3, 3};
  return kNodes[num_random_effects - 1];
}

/// Where the search starts: the pooled curves, people who differ by a fifth, and a lapse in a
/// hundred. Absent, with a reason, where a condition's pooled answers have no curve.
std::optional<Eigen::VectorXd> start_of(const Arranged& all,
                                        const HierarchicalStructure& structure,
                                        std::string& reason) {
  constexpr double kSlopeSd = 0.2, kPlaceSd = 0.1, kLapseAngle = 0.15;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(structure.num_parameters);
  if (structure.has_lapses) start(structure.angle_at()) = kLapseAngle;
  for (int condition = 0; condition < structure.num_conditions; ++condition) {
    const auto at = static_cast<std::size_t>(condition);
    const PsychometricFit pooled =
        fit_psychometric(all.pooled[at], {.reference = all.reference[at],
                                          .free_pse = structure.has_places,
                                          .by_order = true,
                                          .intervals = false,
                                          .solver = Solver::kNewton});
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

/// The better of two searches where there is a lapse rate. None is a maximum of its own beside
/// one with some lapses and steeper curves, and which of them a single search comes to hangs on
/// nothing but where it starts: the second one starts on the other side of the first one's end,
/// from the best curves there.
HierarchicalOptimum better_optimum(const HierarchicalLikelihood& likelihood,
                                   const HierarchicalStructure& structure,
                                   const Eigen::VectorXd& start) {
  constexpr double kNoLapses = 1e-6, kSomeLapsesAngle = 0.2;  // 2 in a hundred.
  HierarchicalOptimum first = most_likely(likelihood, start);
  if (!structure.has_lapses) return first;
  const bool found_some =
      first.status == FitStatus::kOk && structure.lapse_rate(first.parameters) > kNoLapses;
  Eigen::VectorXd other = start;
  other(structure.angle_at()) = found_some ? 0.0 : kSomeLapsesAngle;
  HierarchicalOptimum second =
      most_likely(likelihood, most_likely_with(likelihood, other, structure.angle_at()));
  const bool is_better =
      first.status != FitStatus::kOk || second.log_likelihood > first.log_likelihood;
  return second.status == FitStatus::kOk && is_better ? second : first;
}

std::optional<double> fraction_at(HierarchicalLink link, double slope_number) {
  const double slope =
      link == HierarchicalLink::kLinear ? slope_number : std::exp(slope_number);
  const double fraction = std::expm1(1.0 / slope);
  return slope > 0.0 && std::isfinite(fraction) ? std::optional(fraction) : std::nullopt;
}

/// Half the 95 % interval of a number with this variance.
double reach_of(double variance, int num_participants) {
  const double n = num_participants;
  const double t = boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
  return t * std::sqrt(variance * n / (n - 1.0));
}

double pse_of(HierarchicalLink link, double reference, double slope_number, double place) {
  return reference *
         std::exp(link == HierarchicalLink::kLinear ? -place / slope_number : place);
}

/// The pse's interval: on ln pse, for a linear one by the delta method.
Interval pse_interval(const HierarchicalStructure& structure, const HierarchicalOptimum& found,
                      int condition, double pse, int num_participants) {
  const int place_at = structure.place_at(condition);
  Eigen::VectorXd by_parameter = Eigen::VectorXd::Zero(structure.num_parameters);
  by_parameter(place_at) = 1.0;
  if (structure.link == HierarchicalLink::kLinear) {
    const double slope = found.parameters(condition);
    by_parameter(place_at) = -1.0 / slope;
    by_parameter(condition) = found.parameters(place_at) / (slope * slope);
  }
  const double reach =
      reach_of(by_parameter.dot(found.covariance * by_parameter), num_participants);
  return {pse * std::exp(-reach), pse * std::exp(reach)};
}

void fill_conditions(HierarchicalFit& fit, const Arranged& all,
                     const HierarchicalStructure& structure, const HierarchicalOptimum& found,
                     const HierarchicalOptions& options) {
  for (int condition = 0; condition < structure.num_conditions; ++condition) {
    const auto at = static_cast<std::size_t>(condition);
    HierarchicalCondition one{.condition = all.conditions[at],
                              .num_participants = all.num_in_condition[at]};
    one.slope_number = found.parameters(condition);
    one.slope_standard_error = std::sqrt(found.covariance(condition, condition));
    one.weber_fraction = fraction_at(options.link, one.slope_number);
    if (one.num_participants >= 2) {
      const double reach =
          reach_of(found.covariance(condition, condition), one.num_participants);
      one.weber_fraction_ci95 = {fraction_at(options.link, one.slope_number + reach),
                                 fraction_at(options.link, one.slope_number - reach)};
    }
    one.pse = all.reference[at];
    if (structure.has_places) {
      const int place_at = structure.place_at(condition);
      one.place_number = found.parameters(place_at);
      one.place_standard_error = std::sqrt(found.covariance(place_at, place_at));
      one.pse = pse_of(options.link, all.reference[at], one.slope_number, one.place_number);
      one.pse_ci95 = one.num_participants < 2 ? Interval{}
                                              : pse_interval(structure, found, condition,
                                                             *one.pse, one.num_participants);
    }
    double slope_variance = 0.0;
    for (const HierarchicalStructure::Loading& loading : structure.loadings) {
      const double value = found.parameters(loading.parameter);
      if (loading.number == condition) slope_variance += value * value;
      if (loading.number == structure.own_place_at(condition)) one.place_sd = std::fabs(value);
    }
    one.slope_sd = std::sqrt(slope_variance);
    if (one.slope_sd <= kNoSpread) one.slope_sd = 0.0;  // As the note then says.
    fit.conditions.push_back(std::move(one));
  }
}

/// Of the difference of two slope numbers, the sandwich's; 0 where people's scores are alike
/// but for rounding.
double difference_variance(const HierarchicalOptimum& found, Eigen::Index second) {
  constexpr double kRounding = 1e-12;
  const double by_model = found.covariance(second, second) + found.covariance(0, 0) -
                          2.0 * found.covariance(second, 0);
  const double by_people = (found.influence.row(second) - found.influence.row(0)).squaredNorm();
  return by_people > kRounding * by_model ? by_people : 0.0;
}

void fill_differences(HierarchicalFit& fit, const HierarchicalOptimum& found,
                      HierarchicalLink link) {
  const double sign = link == HierarchicalLink::kLogSlope ? -1.0 : 1.0;
  for (std::size_t second = 1; second < fit.conditions.size(); ++second) {
    const auto at = static_cast<Eigen::Index>(second);
    HierarchicalDifference one{.first = fit.conditions[0].condition,
                               .second = fit.conditions[second].condition};
    one.estimate = sign * (found.parameters(at) - found.parameters(0));
    const double variance = difference_variance(found, at);
    const int n =
        std::min(fit.conditions[0].num_participants, fit.conditions[second].num_participants);
    if (n >= 2 && variance > 0.0) {
      const double reach = reach_of(variance, n);
      one.degrees_of_freedom = n - 1.0;
      one.standard_error = std::sqrt(variance * n / (n - 1.0));
      one.ci95 = {one.estimate - reach, one.estimate + reach};
      one.statistic = one.estimate / *one.standard_error;
      one.p_value = 2.0 * boost::math::cdf(boost::math::complement(
                              boost::math::students_t(n - 1.0), std::fabs(*one.statistic)));
    }
    fit.differences.push_back(std::move(one));
  }
}

/// Correlation of the slopes in two conditions, and a word on spreads that ended at 0.
void fill_spread(HierarchicalFit& fit, const HierarchicalStructure& structure,
                 const HierarchicalOptimum& found) {
  const bool correlated = structure.num_conditions == 2 && structure.loadings.size() >= 3 &&
                          structure.loadings[2].number == 1;
  if (correlated && fit.conditions[0].slope_sd > kNoSpread &&
      fit.conditions[1].slope_sd > kNoSpread) {
    const double own = found.parameters(structure.loadings[0].parameter);
    const double shared = found.parameters(structure.loadings[1].parameter);
    fit.correlation = std::copysign(1.0, own) * shared / fit.conditions[1].slope_sd;
  }
  constexpr double kOne = 0.999;
  if (fit.correlation && std::fabs(*fit.correlation) > kOne) {
    fit.note =
        "the correlation of the slopes is at its bound (a singular fit): the answers tell no "
        "difference of people's own in the one condition from that in the other";
  }
  const bool none =
      std::any_of(fit.conditions.begin(), fit.conditions.end(),
                  [](const HierarchicalCondition& one) { return one.slope_sd <= kNoSpread; });
  if (none) {
    fit.note =
        "the spread of the slopes between people is at its bound 0: the answers show none "
        "beyond chance, which with few answers a person does not mean that there is none";
  }
}

void fill_lapse_rate(HierarchicalFit& fit, const HierarchicalStructure& structure,
                     const HierarchicalOptimum& found) {
  if (!structure.has_lapses) return;
  constexpr double kManyLapses = 0.1, kNoLapses = 1e-8;
  fit.lapse_rate = structure.lapse_rate(found.parameters);
  if (*fit.lapse_rate < kNoLapses) fit.lapse_rate = 0.0;
  if (*fit.lapse_rate < kManyLapses) return;
  fit.note += fit.note.empty() ? "" : "; ";
  fit.note +=
      "more than one answer in five looks random: somebody may have had another task, or "
      "turned "
      "the answers round";
}

/// Why a condition's answers have no curve, whatever its pse; "" if nothing forbids one.
std::string why_no_curve(const Arranged& all) {
  for (std::size_t condition = 0; condition < all.conditions.size(); ++condition) {
    const auto& rows = all.pooled[condition];
    const auto none = [](const AnswerCount& row) { return row.num_yes == 0; };
    const auto every = [](const AnswerCount& row) { return row.num_yes == row.num_trials; };
    if (!std::ranges::all_of(rows, none) && !std::ranges::all_of(rows, every)) continue;
    const std::string& name = all.conditions[condition];
    return (name.empty() ? "" : name + ": ") +
           "all alike: everybody's every answer is the same, so nothing tells how fine the "
           "discrimination is";
  }
  return "";
}

void tell_alike_people(HierarchicalFit& fit) {
  const bool any = std::ranges::any_of(
      fit.differences, [](const HierarchicalDifference& one) { return !one.standard_error; });
  if (!any) return;
  fit.note += fit.note.empty() ? "" : "; ";
  fit.note += "no interval of a difference: people's answers are all alike";
}

/// One person says nothing of a median person: no value for such a condition, nor for a
/// difference with it.
void leave_out_single_people(HierarchicalFit& fit) {
  for (HierarchicalCondition& one : fit.conditions) {
    if (one.num_participants >= 2) continue;
    one.weber_fraction.reset();
    one.pse.reset();
    if (one.pse_ci95) one.pse_ci95 = Interval{};
    fit.note += (fit.note.empty() ? "" : "; ") + one.condition +
                ": no value, for one participant says nothing of how people differ";
    std::erase_if(fit.differences, [&](const HierarchicalDifference& difference) {
      return difference.first == one.condition || difference.second == one.condition;
    });
  }
}

}  // namespace

HierarchicalFit fit_hierarchical(const std::vector<ParticipantAnswers>& answers,
                                 const HierarchicalOptions& options) {
  const Arranged all = arranged(answers);
  HierarchicalFit fit;
  fit.num_participants = static_cast<int>(all.people.size());
  const auto num_conditions = static_cast<int>(all.conditions.size());
  const bool has_orders = std::ranges::count(all.has_orders_in, true) > 0;
  const int most_conditions = options.slopes == HierarchicalSlopes::kCorrelated         ? 2
                              : options.pse == HierarchicalPse::kPersonal || has_orders ? 4
                                                                                        : 8;
  if (num_conditions > most_conditions) {
    throw core::Error(
        "conditions: expected one or two, up to four with shared slopes, or up to eight where "
        "nobody has a pse or a bias in each, found " +
        std::to_string(num_conditions));
  }
  fit.status = FitStatus::kDegenerate;
  if (all.yes_at_zero) {
    fit.reason =
        "impossible: a yes at intensity 0 has probability 0 on every curve; leave the trials "
        "at "
        "intensity 0 out";
    return fit;
  }
  if (fit.num_participants < 2) {
    fit.reason = "fewer than two participants with answers: how people differ is unknown";
    return fit;
  }
  fit.reason = why_no_curve(all);
  if (!fit.reason.empty()) return fit;
  const HierarchicalStructure structure =
      structure_of(all.has_orders_in, anybody_in_several(all), options);
  fit.num_nodes =
      options.num_nodes > 0 ? options.num_nodes : usual_num_nodes(structure.num_random_effects);
  fit.method = method_words(options, all.has_orders_in, fit.num_nodes);
  const std::optional<Eigen::VectorXd> start = start_of(all, structure, fit.reason);
  if (!start) return fit;
  const HierarchicalLikelihood likelihood(structure, all.people, fit.num_nodes);
  const HierarchicalOptimum found = better_optimum(likelihood, structure, *start);
  fit.status = found.status;
  fit.reason = found.reason;
  if (found.status != FitStatus::kOk) return fit;

  fit.log_likelihood = found.log_likelihood - structure.log_prior(found.parameters);
  fill_conditions(fit, all, structure, found, options);
  fill_differences(fit, found, options.link);
  fill_spread(fit, structure, found);
  fill_lapse_rate(fit, structure, found);
  leave_out_single_people(fit);
  tell_alike_people(fit);
  const std::vector<Eigen::VectorXd> modes = likelihood.modes(found.parameters);
  for (std::size_t person = 0; person < all.people.size(); ++person) {
    for (const HierarchicalCell& cell : all.people[person]) {
      fit.participants.push_back({all.participants[person],
                                  all.conditions[static_cast<std::size_t>(cell.condition)],
                                  fraction_at(options.link, modes[person](cell.condition))});
    }
  }
  return fit;
}

}  // namespace jnd::analysis
