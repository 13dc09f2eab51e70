#include "analysis/results/sequential_results.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/results/number_words.h"
#include "analysis/statistics/sequential_estimate.h"
#include "analysis/words/said.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

using experiments::PlannedContrast;
using experiments::SequentialPlan;

const PlannedContrast& deciding_contrast(const experiments::Study& study) {
  if (study.sequential) {
    for (const PlannedContrast& one : study.contrasts) {
      if (one.name == study.sequential->contrast) return one;
    }
  }
  throw core::Error(study.name +
                    ": expected a study that plans looks at one of its contrasts, found none");
}

std::vector<std::vector<std::string>> people_of(const std::vector<TakenLook>& looks) {
  std::vector<std::vector<std::string>> people;
  for (const TakenLook& look : looks) people.push_back(look.participants);
  return people;
}

/// The outcome as the looks reported it. Whether the study ended does not depend on today's
/// data.
SequentialOutcome told_outcome(const StudyData& data, const SequentialBoundaries& boundaries) {
  if (data.looks.empty()) return {};
  SequentialOutcome outcome{.estimates = estimates_at_looks(data, people_of(data.looks)),
                            .ended = data.ended_by_rule()};
  outcome.significant =
      crosses(boundaries, outcome.estimates.size() - 1, outcome.estimates.back());
  return outcome;
}

SequentialResult result_of(const StudyData& data, const SequentialBoundaries& boundaries,
                           const SequentialOutcome& outcome) {
  SequentialResult result{.looks = boundaries.rule.looks,
                          .nominal_levels = boundaries.nominal_level,
                          .num_looks_taken = static_cast<int>(data.looks.size()),
                          .ended = outcome.ended,
                          .significant = outcome.significant};
  for (const TakenLook& look : data.looks) result.num_participants += look.num_sessions;
  return result;
}

Equivalence adjusted_equivalence(const PlannedContrast& plan,
                                 const SequentialEstimate& estimate) {
  const double margin = *plan.smallest_effect;
  const double on_scale = is_ratio(plan.measure) ? std::log(margin) : margin;
  const Interval interval = estimate.interval(1.0 - 2.0 * plan.alpha);
  Equivalence found{
      .margin = margin,
      .interval = {told_effect(plan, interval.low), told_effect(plan, interval.high)}};
  found.p_value =
      std::max(estimate.probability_above(-on_scale), estimate.probability_below(on_scale));
  found.is_shown = found.p_value < plan.alpha;
  return found;
}

/// Replaces the result without looks by the result under the rule.
void put_adjusted(ContrastResult& result, const StudyData& data,
                  const SequentialBoundaries& boundaries, const SequentialOutcome& outcome) {
  result.otherwise.insert(result.otherwise.begin(), std::move(result.test));
  for (ContrastTest& other : result.otherwise)
    other.method += said(", not adjusted for the looks");
  result.equivalence.reset();
  const bool is_one_group = contrast_conditions(data.written, result.plan).groups.size() == 1;
  result.test = {
      .method = said("{} t of people's own contrasts in {}, adjusted for the looks (median "
                     "unbiased, stage-wise order){}",
                     std::string(is_one_group ? said("Student's") : said("Welch's")),
                     own_number_words(result.plan.measure),
                     (result.plan.measure == experiments::ContrastMeasure::kWeberFraction
                          ? said("; its effect is a ratio of ln(1 + w)")
                          : "")),
      .num_participants = result.sequential->num_participants};
  const auto estimate = SequentialEstimate::of(boundaries, outcome);
  if (!estimate) {
    result.test.reason =
        "expected people with contrasts of their own at the look that ended the study, found "
        "too few";
    return;
  }
  const Interval ci95 = estimate->interval(0.95);
  result.test.effect = told_effect(result.plan, estimate->median_unbiased());
  result.test.ci95 = {told_effect(result.plan, ci95.low), told_effect(result.plan, ci95.high)};
  result.test.statistic = outcome.estimates.back()->statistic();
  result.test.degrees_of_freedom = outcome.estimates.back()->degrees_of_freedom;
  result.test.p_value = estimate->p_value();
  if (result.plan.smallest_effect) {
    result.equivalence = adjusted_equivalence(result.plan, *estimate);
  }
}

std::string ended_words(const SequentialResult& result) {
  return said("the study ended by its rule at look {} of {}, with {} of at most {}",
              std::to_string(result.num_looks_taken), std::to_string(result.looks.size()),
              counted_words(result.num_participants, "participant"),
              std::to_string(result.looks.back()));
}

/// The number of people in the data on whom no look rests.
std::int64_t num_beyond(const StudyData& data) {
  std::int64_t num = std::ssize(data.participants);
  for (const TakenLook& look : data.looks) num -= std::ssize(look.participants);
  return num;
}

void caution_of_ended(ContrastResult& result, const StudyData& data) {
  const SequentialResult& sequential = *result.sequential;
  result.cautions.push_back(ended_words(sequential));
  const bool is_last = std::ssize(sequential.looks) == sequential.num_looks_taken;
  if (!sequential.significant && !is_last) {
    result.cautions.emplace_back(
        said("the look that ended the study was told to stop, but as the data are now they do "
             "not cross its boundary: trials were set aside or somebody withdrew since"));
  }
  if (const std::int64_t num = num_beyond(data); num > 0) {
    result.cautions.push_back(said("of {} beyond those looks nothing is in this value",
                                   counted_words(num, "participant")));
  }
}

}  // namespace

SequentialRule sequential_rule(const experiments::Study& study) {
  const PlannedContrast& decides = deciding_contrast(study);
  const SequentialPlan& plan = *study.sequential;
  return {.looks = plan.looks,
          .spending = plan.spending == experiments::AlphaSpending::kPocock
                          ? SpendingFunction::kPocock
                          : SpendingFunction::kObrienFleming,
          .alpha = decides.alpha,
          .tail = tail_of(decides)};
}

std::vector<std::optional<EffectEstimate>> estimates_at_looks(
    const StudyData& data, const std::vector<std::vector<std::string>>& people_by_look) {
  const PlannedContrast& decides = deciding_contrast(data.written);
  const experiments::ContrastConditions conditions = contrast_conditions(data.written, decides);
  if (!conditions.problem.empty()) {
    throw core::Error(data.study + ": contrast " + decides.name + ": " + conditions.problem);
  }
  const OwnContrasts own =
      own_contrasts(condition_numbers(data, decides, conditions), conditions);
  std::map<std::string, std::optional<PersonScore>> score_of;
  for (std::size_t person = 0; person < own.participants.size(); ++person) {
    score_of[own.participants[person]] = own.scores[person];
  }
  std::vector<std::optional<EffectEstimate>> estimates;
  std::vector<std::optional<PersonScore>> scores;
  for (const std::vector<std::string>& people : people_by_look) {
    for (const std::string& name : people) {
      const auto found = score_of.find(name);
      if (found != score_of.end()) scores.push_back(found->second);
    }
    estimates.push_back(estimate_of_first(scores, scores.size(), conditions.groups.size()));
  }
  return estimates;
}

void adjust_for_looks(std::vector<ContrastResult>& results, const StudyData& data) {
  if (!data.written.sequential) return;
  const SequentialBoundaries boundaries = boundaries_of(sequential_rule(data.written));
  const SequentialOutcome outcome = told_outcome(data, boundaries);
  for (ContrastResult& result : results) {
    if (result.plan.name != data.written.sequential->contrast) {
      result.cautions.emplace_back(
          said("the study is one that looks may end; this contrast is not adjusted for them"));
      continue;
    }
    result.sequential = result_of(data, boundaries, outcome);
    if (outcome.ended) {
      put_adjusted(result, data, boundaries, outcome);
      caution_of_ended(result, data);
      continue;
    }
    result.cautions.push_back(
        said("looked at before the rule of the study has ended it, which was not planned: "
             "nothing is adjusted for that, and p < {} is no proof",
             shortest_words(result.plan.alpha)));
  }
}

}  // namespace jnd::analysis
