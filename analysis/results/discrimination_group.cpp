#include "analysis/results/discrimination_group.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "analysis/fits/interval_order_fit.h"
#include "analysis/fits/psychometric_refit.h"
#include "analysis/fits/psychometric_warnings.h"
#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"
#include "analysis/words/said_composed.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

using Everybody = std::vector<DiscriminationAnswers>;

/// Everybody's answers at all levels, in a form that can be summed repeatedly.
class PooledAnswers {
 public:
  explicit PooledAnswers(const Everybody& all) {
    std::map<std::pair<double, double>, std::size_t> places;
    for (const DiscriminationAnswers& one : all) {
      for (const auto& [key, count] : one.cells) places.try_emplace(key);
    }
    for (auto& [key, place] : places) {
      place = levels_.size();
      levels_.push_back({.intensity = key.first, .order = key.second});
    }
    for (const DiscriminationAnswers& one : all) {
      std::vector<Cell>& cells = people_.emplace_back();
      for (const auto& [key, count] : one.cells) cells.push_back({places.at(key), count});
    }
  }

  /// The pooled answers of these people, with one row for each level that any of them has.
  [[nodiscard]] std::vector<AnswerCount> of(const std::vector<std::size_t>& drawn) const {
    std::vector<AnswerCount> rows = levels_;
    for (const std::size_t person : drawn) {
      for (const Cell& cell : people_[person]) {
        rows[cell.level].num_yes += cell.count.num_yes;
        rows[cell.level].num_trials += cell.count.num_trials;
      }
    }
    std::erase_if(rows, [](const AnswerCount& row) { return row.num_trials == 0; });
    return rows;
  }

 private:
  struct Cell {
    std::size_t level = 0;
    AnswerCount count;
  };
  std::vector<AnswerCount> levels_;  ///< The levels without answers, ascending.
  std::vector<std::vector<Cell>> people_;
};

PsychometricFit pooled_fit(const PooledAnswers& answers, double reference,
                           const std::vector<std::size_t>& drawn, PsychometricMethod method,
                           bool free_pse, Solver solver) {
  return fit_psychometric(answers.of(drawn),
                          {.reference = reference,
                           .method = method,
                           .free_pse = free_pse,
                           .by_order = method == PsychometricMethod::kMaximumLikelihood,
                           .intervals = false,
                           .solver = solver});
}

/// The Weber fraction of a fit. Without a fit it is the limit: 0 if larger intensities were
/// called more (separated), and infinite otherwise (flat, inverted).
double fraction_or_limit(const std::optional<double>& fraction, const Everybody& all,
                         const std::vector<std::size_t>& drawn) {
  if (fraction) return *fraction;
  double order = 0.0;
  for (const std::size_t index : drawn) {
    for (const auto& [intensity, count] : all[index].levels) {
      order +=
          (2.0 * static_cast<double>(count.num_yes) - static_cast<double>(count.num_trials)) *
          std::log(intensity / all[index].reference);
    }
  }
  return order > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

/// Where the estimates of one set of people are added, and what is appended to their names and
/// meanings.
struct Target {
  ResultsSection& section;
  const BlockDesign& block;
  const ResultsOptions& options;
  std::string suffix, words;
};

void add(const Target& target, Estimate estimate, const std::string& name,
         const std::string& meaning, std::size_t n) {
  estimate.name = target.block.block + "." + name + target.suffix;
  estimate.meaning = meaning + target.words;
  estimate.n = static_cast<int>(n);
  target.section.estimates.push_back(std::move(estimate));
}

std::string unit_of(const BlockDesign& block) {
  return experiments::unit_of_quantity(block.quantity);
}

void no_value(const Target& target, const std::string& name, const std::string& reason) {
  target.section.excluded.push_back(
      {"everyone",
       said("{}.{}{}: no value, {}", target.block.block, name, target.suffix, reason)});
}

bool have_orders(const Everybody& all) {
  return std::ranges::any_of(
      all, [](const DiscriminationAnswers& one) { return orders_vary(one.rows()); });
}

bool are_all_alike(const Everybody& all) {
  std::vector<AnswerCount> rows;
  for (const DiscriminationAnswers& one : all) {
    for (const AnswerCount& row : one.rows()) rows.push_back(row);
  }
  return all_alike(rows);
}

void add_pooled(const Target& target, const Everybody& all, const std::string& name,
                PsychometricMethod method, bool free_pse, const std::string& meaning) {
  std::vector<std::size_t> everyone(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) everyone[i] = i;
  const PooledAnswers answers(all);
  const double reference = all.front().reference;
  const PsychometricFit fit =
      pooled_fit(answers, reference, everyone, method, free_pse, Solver::kCeres);
  Estimate fraction{.value = fit.weber_fraction, .unit = "1"};
  Estimate pse{.value = fit.pse};
  if (!fit.weber_fraction) {
    fraction.reason = said("the pooled answers are {}", said_composed(fit.reason));
    no_value(target, name, fraction.reason);
  }
  if (fit.weber_fraction && !free_pse && are_all_alike(all)) {
    fraction.cautions.emplace_back(kAllAlike);
  }
  if (!fit.pse) pse.reason = fit.weber_fraction ? why_no_pse(fit) : fraction.reason;
  if (fit.weber_fraction && all.size() > 1) {
    std::vector<double> estimates = {*fit.weber_fraction};
    if (free_pse && fit.pse) estimates.push_back(*fit.pse);
    LeastSquaresFractions least_squares;
    const std::vector<ResampledInterval> intervals = resample_factors(
        all.size(), target.options.num_resamples, target.options.seed, estimates,
        [&](const std::vector<std::size_t>& drawn, std::span<std::optional<double>> values) {
          if (method == PsychometricMethod::kLeastSquares && !free_pse) {
            values[0] =
                fraction_or_limit(least_squares.of(answers.of(drawn), reference), all, drawn);
            return;
          }
          const PsychometricFit other =
              pooled_fit(answers, reference, drawn, method, free_pse, Solver::kNewton);
          values[0] = fraction_or_limit(other.weber_fraction, all, drawn);
          if (values.size() > 1) values[1] = other.pse;
        });
    fraction.ci95 = intervals[0].ci95;
    if (intervals.size() > 1) pse.ci95 = intervals[1].ci95;
  }
  add(target, fraction, name, said("pooled-curve w: {}", meaning), all.size());
  if (fit.order_effect_ln && !free_pse) {
    add(target, {.value = fit.order_effect_ln, .unit = "1"}, name + "_order_effect_ln",
        said("ln pse with the test second less with the test first, of that curve"),
        all.size());
  }
  if (!free_pse) return;
  pse.unit = unit_of(target.block);
  add(target, pse, "pse", said("pse of the pooled curve: {}", meaning), all.size());
}

/// The range of lapse rates for which the interval of a fraction holds, in words.
std::string interval_basis(const HierarchicalFit& fit) {
  const Interval& left = fit.lapse_rate_with_prior_ci95;
  if (!left.low || !left.high) return "";
  return said("; interval over lapse rates of {} to {}, which answers and prior leave",
              number_words(left.low), number_words(left.high));
}

/// How far the prior of the lapse rate moves the fraction, in words.
std::string prior_effect(const HierarchicalFit& fit) {
  if (fit.conditions.empty() || !fit.lapse_rate_without_prior) return "";
  const HierarchicalCondition& one = fit.conditions.front();
  if (!one.weber_fraction || !one.weber_fraction_without_prior) return "";
  const double change = *one.weber_fraction_without_prior / *one.weber_fraction - 1.0;
  const long percent = std::lround(100.0 * change);
  return said(
      "; interval by the answers alone; without its prior {}, and the median person's w {} "
      "({}{} %)",
      number_words(fit.lapse_rate_without_prior),
      number_words(one.weber_fraction_without_prior), (percent > 0 ? "+" : ""),
      std::to_string(percent));
}

void add_median_person(const Target& target, const Everybody& all, HierarchicalPse pse) {
  const bool is_primary = pse == primary_pse(all);
  const bool free_pse = pse == HierarchicalPse::kPersonal;
  const std::string name =
      std::string("weber_fraction_median_person") + (is_primary ? ""
                                                     : free_pse ? "_free_pse"
                                                                : "_at_reference");
  const HierarchicalFit fit =
      fit_hierarchical(participant_answers(all, target.block.block), {.pse = pse});
  Estimate fraction{.unit = "1"}, place{.unit = unit_of(target.block)};
  Estimate spread{.unit = "1"}, lapses{.unit = "1"};
  if (fit.status == FitStatus::kOk) {
    const HierarchicalCondition& one = fit.conditions.front();
    fraction.value = one.weber_fraction;
    fraction.ci95 = one.weber_fraction_ci95;
    fraction.cautions = one.cautions;
    fraction.is_rejected_by_fit = place.is_rejected_by_fit = one.is_rejected_by_fit;
    place.value = one.pse;
    place.ci95 = one.pse_ci95.value_or(Interval{});
    spread.value = one.slope_sd;
    lapses.value = fit.lapse_rate;
    lapses.ci95 = fit.lapse_rate_ci95;
  } else {
    no_value(target, name, fit.reason);
    for (Estimate* missing : {&fraction, &place, &spread, &lapses}) {
      missing->reason = fit.reason;
      missing->is_separated = fit.is_separated;
    }
  }
  const std::string method =
      said("hierarchical {}", said_composed(fit.method.empty() ? "probit" : fit.method));
  add(target, fraction, name,
      said("median person's w: {}{}{}", method,
           (is_primary ? said(" (primary)") : said(" (secondary)")), interval_basis(fit)),
      all.size());
  if (free_pse) {
    add(target, place, "pse_median_person", said("median person's pse: {}", method),
        all.size());
  }
  if (!is_primary) return;
  add(target, spread, "slope_sd_between_people",
      said("sd of ln ln(1 + w) between people: {}{}", method,
           (fit.note.empty() ? "" : "; " + said_composed(fit.note))),
      all.size());
  add(target, lapses, "lapse_rate",
      said("half the share of random answers, of everybody: {}{}", method, prior_effect(fit)),
      all.size());
}

/// Adds the pooled estimate as it was published. If that would pool both orders of the
/// intervals, it keeps them apart.
void add_pooled_at_reference(const Target& target, const Everybody& all,
                             const std::string& words) {
  if (have_orders(all)) {
    add_pooled(
        target, all, "weber_fraction", PsychometricMethod::kMaximumLikelihood, false,
        said("maximum likelihood, pse at the reference but for the order of the intervals"));
  } else {
    add_pooled(target, all, "weber_fraction", PsychometricMethod::kLeastSquares, false,
               said("least squares on proportions, pse at the reference{}", words));
  }
}

/// Adds the estimates that are repeated for another set of people or trials.
void add_main(const Target& target, const Everybody& all) {
  add_pooled_at_reference(target, all, "");
  add_median_person(target, all, primary_pse(all));
}

}  // namespace

HierarchicalPse primary_pse(const Everybody& answers) {
  return have_orders(answers) ? HierarchicalPse::kReference : HierarchicalPse::kPersonal;
}

HierarchicalPse primary_pse(const Everybody& first, const Everybody& second) {
  return have_orders(first) && have_orders(second) ? HierarchicalPse::kReference
                                                   : HierarchicalPse::kPersonal;
}

void add_group_estimates(ResultsSection& section, const StudyData& data,
                         const BlockDesign& block, const ResultsOptions& options) {
  std::vector<ExcludedParticipant> named_before;
  const Everybody all = discrimination_answers(data, block, false, named_before);
  const Target target{section, block, options, "", ""};
  add_pooled_at_reference(target, all, said(", as Schmidt (2018)"));
  if (!have_orders(all)) {
    add_pooled(target, all, "weber_fraction_ml", PsychometricMethod::kMaximumLikelihood, false,
               said("maximum likelihood, pse at the reference"));
  }
  add_pooled(target, all, "weber_fraction_free_pse", PsychometricMethod::kMaximumLikelihood,
             true, said("maximum likelihood, pse free"));
  const bool first_at_reference = primary_pse(all) == HierarchicalPse::kReference;
  for (const bool at_reference : {first_at_reference, !first_at_reference}) {
    add_median_person(target, all,
                      at_reference ? HierarchicalPse::kReference : HierarchicalPse::kPersonal);
  }

  Everybody with_own_fit;
  for (const DiscriminationAnswers& one : all) {
    if (own_fit(one, {}).weber_fraction) with_own_fit.push_back(one);
  }
  if (with_own_fit.size() < all.size() && !with_own_fit.empty()) {
    add_main({section, block, options, ".without_degenerate",
              said("; without those who have no fraction of their own")},
             with_own_fit);
  }
  const bool some_set_aside = std::any_of(
      data.participants.begin(), data.participants.end(), [&](const ParticipantData& one) {
        return std::any_of(
            one.excluded_trials.begin(), one.excluded_trials.end(),
            [&](const core::TrialRow& trial) { return trial.block == block.block; });
      });
  if (some_set_aside) {
    add_main({section, block, options, ".with_excluded_trials",
              said("; with the trials that were set aside")},
             discrimination_answers(data, block, true, named_before));
  }
}

void add_primary_estimate(ResultsSection& section, const StudyData& data,
                          const BlockDesign& block, const ResultsOptions& options) {
  const Everybody all = discrimination_answers(data, block, false, section.excluded);
  if (!all.empty()) add_median_person({section, block, options, "", ""}, all, primary_pse(all));
}

Comparison median_person_difference(const Everybody& first_answers, const BlockDesign& first,
                                    const Everybody& second_answers, const BlockDesign& second,
                                    HierarchicalPse pse) {
  std::vector<ParticipantAnswers> both = participant_answers(first_answers, first.block);
  const std::vector<ParticipantAnswers> others =
      participant_answers(second_answers, second.block);
  both.insert(both.end(), others.begin(), others.end());
  const HierarchicalFit fit = fit_hierarchical(both, {.pse = pse, .lapse_profile = false});
  Comparison comparison{.status = fit.status, .reason = fit.reason, .method = fit.method};
  if (!fit.note.empty()) comparison.method += " (" + fit.note + ")";
  comparison.num_a = static_cast<int>(first_answers.size());
  comparison.num_b = static_cast<int>(second_answers.size());
  comparison.of_other_people = std::ranges::none_of(first_answers, [&](const auto& one) {
    return std::ranges::any_of(second_answers, [&](const auto& other) {
      return other.participant == one.participant;
    });
  });
  if (fit.status != FitStatus::kOk || fit.differences.empty()) {
    if (comparison.status == FitStatus::kOk) comparison.status = FitStatus::kDegenerate;
    if (comparison.reason.empty())
      comparison.reason = said("fewer than two participants in one of the conditions");
    return comparison;
  }
  const HierarchicalDifference& difference = fit.differences.front();
  const auto negated = [](const std::optional<double>& value) {
    return value ? std::optional(-*value) : std::nullopt;
  };
  comparison.estimate = -difference.estimate;  // The result is the first minus the second.
  comparison.ci95 = {negated(difference.ci95.high), negated(difference.ci95.low)};
  comparison.statistic = negated(difference.statistic);
  comparison.p_value = difference.p_value;
  comparison.degrees_of_freedom = difference.degrees_of_freedom;
  return comparison;
}

}  // namespace jnd::analysis
