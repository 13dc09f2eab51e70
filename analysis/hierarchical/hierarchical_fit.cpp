#include "analysis/hierarchical/hierarchical_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/hierarchical/hierarchical_arrangement.h"
#include "analysis/hierarchical/hierarchical_cautions.h"
#include "analysis/hierarchical/hierarchical_lapses.h"
#include "analysis/hierarchical/hierarchical_levels.h"
#include "analysis/hierarchical/hierarchical_nested.h"
#include "analysis/hierarchical/hierarchical_robust.h"
#include "analysis/hierarchical/hierarchical_words.h"
#include "analysis/statistics/distributions.h"
#include "core/error.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// A smaller lapse rate counts as none, because a search leaves about as much of 0.
constexpr double kNoLapses = 1e-8;

/// The usual number of nodes in each dimension. Lapse rates of people's own add a dimension but
/// have their own nodes, so they do not count.
int usual_num_nodes(const HierarchicalStructure& structure) {
  constexpr int kNodes[] = {15, 9, 5, 3, 3, 3};
  return kNodes[structure.num_random_effects - (structure.has_own_lapses ? 0 : 1)];
}

/// Half the width of the 95 % interval of a number with this variance.
double reach_of(double variance, int num_participants) {
  const double n = num_participants;
  const double t = student_t_quantile(0.975, n - 1.0);
  return t * std::sqrt(variance * n / (n - 1.0));
}

double pse_of(HierarchicalLink link, double reference, double slope_number, double place) {
  return reference *
         std::exp(link == HierarchicalLink::kLinear ? -place / slope_number : place);
}

/// The pse's interval, computed for ln pse. For a linear link it uses the delta method.
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

/// The least |z| of the median person over the levels of a condition.
double least_level_z(const HierarchicalArrangement& all, const HierarchicalStructure& structure,
                     const Eigen::VectorXd& parameters, int condition) {
  const double number = parameters(condition);
  const double place = structure.has_places ? parameters(structure.place_at(condition)) : 0.0;
  const double by_order =
      structure.has_orders() ? parameters(structure.order_at(condition)) : 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const HierarchicalPerson& person : all.people) {
    for (const HierarchicalCell& cell : person) {
      if (cell.condition != condition) continue;
      for (std::size_t level = 0; level < cell.log_ratio.size(); ++level) {
        const double at = place + by_order * cell.order[level], u = cell.log_ratio[level];
        const double z = structure.link == HierarchicalLink::kLinear
                             ? number * u + at
                             : std::exp(number) * (u - at);
        least = std::min(least, std::fabs(z));
      }
    }
  }
  return least;
}

void fill_conditions(HierarchicalFit& fit, const HierarchicalArrangement& all,
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
    one.least_level_z = least_level_z(all, structure, found.parameters, condition);
    double slope_variance = 0.0;
    for (const HierarchicalStructure::Loading& loading : structure.loadings) {
      const double value = found.parameters(loading.parameter);
      if (loading.number == condition) slope_variance += value * value;
      if (loading.number == structure.own_place_at(condition)) one.place_sd = std::fabs(value);
    }
    one.slope_sd = std::sqrt(slope_variance);
    for (double* spread : {&one.slope_sd, &one.place_sd}) {
      if (*spread <= kNoSpread) *spread = 0.0;  // The note reports this spread as none.
    }
    fit.conditions.push_back(std::move(one));
  }
}

/// The variance of the difference of two slope numbers, by the sandwich estimator. It is 0 if
/// people's scores are equal except for rounding.
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
      one.p_value = 2.0 * student_t_above(std::fabs(*one.statistic), n - 1.0);
    }
    fit.differences.push_back(std::move(one));
  }
}

/// Fills in the correlation of the slopes in two conditions.
void fill_correlation(HierarchicalFit& fit, const HierarchicalStructure& structure,
                      const HierarchicalOptimum& found) {
  const bool correlated = structure.num_conditions == 2 && structure.loadings.size() >= 3 &&
                          structure.loadings[2].number == 1;
  if (correlated && fit.conditions[0].slope_sd > kNoSpread &&
      fit.conditions[1].slope_sd > kNoSpread) {
    const double own = found.parameters(structure.loadings[0].parameter);
    const double shared = found.parameters(structure.loadings[1].parameter);
    fit.correlation = std::copysign(1.0, own) * shared / fit.conditions[1].slope_sd;
  }
}

void fill_lapse_rate(HierarchicalFit& fit, const HierarchicalStructure& structure,
                     const HierarchicalOptimum& found, HierarchicalLapses lapses) {
  if (lapses == HierarchicalLapses::kKnown) fit.lapse_rate = structure.known_lapse_rate;
  if (!structure.has_lapses) return;
  constexpr double kManyLapses = 0.1;
  fit.lapse_rate = structure.lapse_rate(found.parameters);
  if (*fit.lapse_rate < kNoLapses) fit.lapse_rate = 0.0;
  if (*fit.lapse_rate < kManyLapses) return;
  add_note(fit,
           "more than one answer in five looks random: somebody may have had another task, or "
           "turned the answers round");
}

/// Widens each interval to the union of three: that at the most likely lapse rate, and those at
/// both ends of the lapse rate's interval. More lapses mean a steeper curve.
void widen_intervals(HierarchicalFit& fit, LapseProfile& profile, HierarchicalLink link) {
  const Interval& left = fit.lapse_rate_with_prior_ci95;
  for (std::size_t condition = 0; condition < fit.conditions.size(); ++condition) {
    HierarchicalCondition& one = fit.conditions[condition];
    if (one.num_participants < 2) continue;
    const auto at = static_cast<Eigen::Index>(condition);
    const auto widen = [&](const std::optional<double>& lapse_rate) {
      const std::optional<double> variance =
          lapse_rate ? profile.variance_at(*lapse_rate, static_cast<int>(condition))
                     : std::nullopt;
      if (!variance) {
        // With this many lapses there is no curve, so the slope has no upper bound.
        one.weber_fraction_ci95.low.reset();
        return;
      }
      const double slope = profile.at(*lapse_rate).parameters(at);
      const double reach = reach_of(*variance, one.num_participants);
      const std::optional<double> low = fraction_at(link, slope + reach);
      const std::optional<double> high = fraction_at(link, slope - reach);
      if (one.weber_fraction_ci95.low && low) {
        one.weber_fraction_ci95.low = std::min(*one.weber_fraction_ci95.low, *low);
      }
      if (!high) one.weber_fraction_ci95.high.reset();
      if (one.weber_fraction_ci95.high && high) {
        one.weber_fraction_ci95.high = std::max(*one.weber_fraction_ci95.high, *high);
      }
    };
    widen(left.low);
    widen(left.high);
  }
}

/// Computes the profile of the lapse rate, and its effect on the other values.
void fill_lapse_profile(HierarchicalFit& fit, LapseProfile& profile, HierarchicalLink link) {
  if (fit.own_lapses) {
    fit.lapse_rate_with_prior_ci95 = profile.interval(true);
    return widen_intervals(fit, profile, link);
  }
  fit.lapse_rate_ci95 = profile.interval(false);
  fit.lapse_rate_with_prior_ci95 = profile.interval(true);
  fit.lapse_rate_without_prior = profile.without_prior();
  const LapseProfile::Point& without_prior = profile.at(profile.without_prior());
  for (std::size_t condition = 0; condition < fit.conditions.size(); ++condition) {
    fit.conditions[condition].weber_fraction_without_prior =
        fraction_at(link, without_prior.parameters(static_cast<Eigen::Index>(condition)));
  }
  widen_intervals(fit, profile, link);
}

/// Adds what options of `jnd fit hierarchical` ask for beyond the plain model.
void fill_robust(HierarchicalFit& fit, const HierarchicalArrangement& all, NestedOptima& nested,
                 const HierarchicalLikelihood& likelihood,
                 const HierarchicalStructure& structure, const Eigen::VectorXd& start,
                 const HierarchicalOptimum& found, const HierarchicalOptions& options) {
  if (structure.has_scatter) {
    fit.scatter =
        scatter_of(nested, likelihood, structure, start, found, options.correlation_interval);
  }
  if (structure.has_own_lapses) fit.own_lapses = own_lapses_of(nested, structure, found);
  if (structure.has_lapses && options.prior_sensitivity) {
    fit.prior_effects = prior_effects(all, structure, found, fit.num_nodes);
  }
}

/// Adds cautions about levels that are too hard. `profile` is null if the fit has no free lapse
/// rate.
void fill_ease(HierarchicalFit& fit, const HierarchicalArrangement& all,
               const HierarchicalStructure& structure, const HierarchicalOptimum& found,
               LapseProfile* profile) {
  constexpr double kSomeLapses = 0.03;
  for (int condition = 0; condition < structure.num_conditions; ++condition) {
    HierarchicalCondition& one = fit.conditions[static_cast<std::size_t>(condition)];
    const LevelEase ease = level_ease(all, structure, found.parameters, condition);
    one.easy_ratio = ease.easy_ratio;
    if (!one.weber_fraction || !are_hard(ease)) continue;
    std::optional<double> with_lapses;
    if (profile != nullptr && profile->with_prior() < kSomeLapses) {
      const LapseProfile::Point& point = profile->at(kSomeLapses);
      if (point.exists) {
        with_lapses = fraction_at(structure.link, point.parameters(condition));
      }
    }
    one.cautions = {hard_levels(ease, *one.weber_fraction, with_lapses)};
  }
}

/// Why a condition's answers have no curve at any pse; "" if nothing rules one out.
std::string why_no_curve(const HierarchicalArrangement& all) {
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

/// `lapse_rates` holds people's own lapse rates. It is empty if they have none.
void fill_people(HierarchicalFit& fit, const HierarchicalArrangement& all,
                 const std::vector<Eigen::VectorXd>& modes,
                 const std::vector<double>& lapse_rates, HierarchicalLink link) {
  for (std::size_t person = 0; person < all.people.size(); ++person) {
    for (const HierarchicalCell& cell : all.people[person]) {
      const auto condition = static_cast<std::size_t>(cell.condition);
      HierarchicalPersonEstimate one{
          .participant = all.participants[person],
          .condition = all.conditions[condition],
          .weber_fraction = fraction_at(link, modes[person](cell.condition))};
      if (!lapse_rates.empty()) {
        one.lapse_rate = lapse_rates[person] < kNoLapses ? 0.0 : lapse_rates[person];
      }
      if (!fit.conditions[condition].weber_fraction) {
        one.weber_fraction.reset();
        one.reason = "the condition has no value";
      } else if (!one.weber_fraction) {
        one.reason =
            "the answers do not rise, or so little that the value exceeds the range of "
            "numbers";
      } else if (*one.weber_fraction > largest_fraction(all, condition)) {
        one.cautions = {
            "beyond the largest stimulus: how large it is hangs on the curve's form and on how "
            "people differ more than on this person's answers"};
      }
      fit.participants.push_back(std::move(one));
    }
  }
}

}  // namespace

std::optional<double> fraction_at(HierarchicalLink link, double slope_number) {
  const double slope =
      link == HierarchicalLink::kLinear ? slope_number : std::exp(slope_number);
  const double fraction = std::expm1(1.0 / slope);
  return slope > 0.0 && std::isfinite(fraction) ? std::optional(fraction) : std::nullopt;
}

HierarchicalFit fit_hierarchical(const std::vector<ParticipantAnswers>& answers,
                                 const HierarchicalOptions& options) {
  core::require(options.guess_rate >= 0.0 && options.guess_rate < 1.0, "guess_rate",
                "a number from 0 to below 1", options.guess_rate);
  const double lapse_limit = options.guess_rate > 0.0 ? 1.0 - options.guess_rate : 0.5;
  core::require(options.lapse_rate >= 0.0 && options.lapse_rate < lapse_limit, "lapse_rate",
                "a number from 0 that leaves the curve a rise", options.lapse_rate);
  for (const double parameter : {options.lapse_prior.a, options.lapse_prior.b}) {
    core::require(parameter >= 1.0 && parameter <= kLargestPriorParameter, "lapse_prior",
                  "numbers from 1 to 1e6", parameter);
  }
  const HierarchicalArrangement all = arranged(answers);
  HierarchicalFit fit;
  fit.lapse_prior = options.lapse_prior;
  fit.guess_rate = options.guess_rate;
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
  if (all.yes_at_zero && options.guess_rate == 0.0) {
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
  if (options.beta_binomial && are_all_single(all)) {
    fit.reason =
        "nobody answered any level twice, so nothing tells how answers to one level scatter";
    return fit;
  }
  const HierarchicalStructure structure = structure_of(all, options);
  fit.num_nodes = options.num_nodes > 0 ? options.num_nodes : usual_num_nodes(structure);
  fit.method = method_words(options, all.has_orders_in, fit.num_nodes);
  const std::optional<Eigen::VectorXd> start = start_of(all, structure, fit.reason);
  if (!start) return fit;
  const HierarchicalLikelihood likelihood(structure, all.people, fit.num_nodes);
  NestedOptima nested(all.people, structure, *start, fit.num_nodes);
  const HierarchicalOptimum found =
      structure.has_scatter || structure.has_own_lapses
          ? nested.of(structure.has_scatter, structure.has_own_lapses)
          : better_optimum(likelihood, structure, *start);
  fit.status = found.status;
  fit.reason = found.reason;
  fit.is_separated = found.is_separated;
  if (found.status != FitStatus::kOk) return fit;

  fit.log_likelihood = found.log_likelihood - structure.log_prior(found.parameters);
  fill_conditions(fit, all, structure, found, options);
  fill_differences(fit, found, options.link);
  fit.influence = found.influence.topRows(num_conditions * (structure.has_places ? 2 : 1));
  fit.people = all.participants;
  fill_correlation(fit, structure, found);
  const bool has_own_places = options.pse != HierarchicalPse::kCommon &&
                              (options.pse != HierarchicalPse::kReference || has_orders);
  note_spreads_at_bounds(fit, has_own_places);
  fill_lapse_rate(fit, structure, found, options.lapses);
  fill_robust(fit, all, nested, likelihood, structure, *start, found, options);
  std::optional<LapseProfile> profile;
  if (structure.has_lapses && options.lapse_profile) {
    profile.emplace(likelihood, structure, *start, found);
    fill_lapse_profile(fit, *profile, options.link);
  }
  leave_out_what_is_not_told(fit);
  if (fit.status != FitStatus::kOk) return fit;
  fill_ease(fit, all, structure, found, profile ? &*profile : nullptr);
  if (!structure.has_scatter) {
    caution_of_misfit(fit, likelihood.misfit_p_value(found.parameters));
  }
  note_alike_people(fit);
  fill_people(fit, all, likelihood.modes(found.parameters),
              structure.has_own_lapses ? likelihood.lapse_rates(found.parameters)
                                       : std::vector<double>{},
              options.link);
  return fit;
}

}  // namespace jnd::analysis
