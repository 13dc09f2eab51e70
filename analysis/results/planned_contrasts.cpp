#include "analysis/results/planned_contrasts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "analysis/fits/psychometric_warnings.h"
#include "analysis/hierarchical/hierarchical_contrast.h"
#include "analysis/results/contrast_answers.h"
#include "analysis/results/contrast_words.h"
#include "analysis/results/sequential_results.h"
#include "analysis/statistics/comparison.h"
#include "analysis/statistics/multiplicity.h"
#include "analysis/words/said.h"
#include "analysis/words/said_composed.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

using experiments::ContrastConditions;
using experiments::ContrastDirection;
using experiments::ContrastMeasure;
using experiments::PlannedContrast;

Interval told(const PlannedContrast& plan, const Interval& interval) {
  return {told_effect(plan, interval.low), told_effect(plan, interval.high)};
}

constexpr double kConfidence = 0.95;

ContrastTest test_of(const PlannedContrast& plan, const std::optional<EffectEstimate>& estimate,
                     std::string method, int num_participants, std::string reason) {
  ContrastTest test{.method = std::move(method), .num_participants = num_participants};
  if (!estimate) {
    test.reason = std::move(reason);
    return test;
  }
  test.effect = told_effect(plan, estimate->effect);
  test.ci95 = told(plan, interval_of(*estimate, kConfidence));
  test.statistic = estimate->statistic();
  test.degrees_of_freedom = estimate->degrees_of_freedom;
  test.p_value = p_value_of(*estimate, tail_of(plan));
  return test;
}

Equivalence equivalence_of(const PlannedContrast& plan, const EffectEstimate& estimate) {
  const double margin = *plan.smallest_effect;
  Equivalence found{.margin = margin,
                    .interval = told(plan, interval_of(estimate, 1.0 - 2.0 * plan.alpha))};
  found.p_value =
      equivalence_p_value(estimate, is_ratio(plan.measure) ? std::log(margin) : margin);
  found.is_shown = found.p_value < plan.alpha;
  return found;
}

/// The weighted sums by group, for people who have every number that they need.
struct Scores {
  std::vector<std::vector<double>> by_group;
  std::vector<ExcludedParticipant> excluded;
  int num_participants = 0;
};

Scores scores_of(const OwnContrasts& own, std::size_t num_groups, const PlannedContrast& plan) {
  Scores scores{.by_group = std::vector<std::vector<double>>(num_groups)};
  for (std::size_t person = 0; person < own.participants.size(); ++person) {
    const std::optional<PersonScore>& score = own.scores[person];
    if (score) {
      scores.by_group[score->group].push_back(score->score);
      ++scores.num_participants;
      continue;
    }
    scores.excluded.push_back(
        {own.participants[person],
         said("no {} of their own in {}", said_measure(plan), own.lacking[person])});
  }
  return scores;
}

std::string people_words(const ContrastConditions& conditions) {
  return conditions.groups.size() == 1 ? said("Student's t of people's own contrasts")
                                       : said("Welch's t of people's own contrasts");
}

constexpr const char* kTooFew = said_later(
    "expected two or more people in each group who differ from each other, found fewer");

/// The test by ranks, which assumes no distribution. It exists only for a single group.
std::optional<ContrastTest> by_ranks(const PlannedContrast& plan, const Scores& scores,
                                     const std::string& numbers) {
  if (scores.by_group.size() != 1 || scores.by_group.front().empty()) return std::nullopt;
  const std::vector<double>& values = scores.by_group.front();
  const Comparison ranks = wilcoxon_test(values, std::vector<double>(values.size(), 0.0));
  ContrastTest test{
      .method = said("{} of people's own {}, two-sided", said_composed(ranks.method), numbers),
      .num_participants = scores.num_participants,
      .reason = ranks.reason};
  test.effect = told_effect(plan, ranks.hodges_lehmann);
  test.ci95 = told(plan, ranks.hodges_lehmann_ci95);
  test.statistic = ranks.statistic;
  test.statistic_name = ranks.statistic_name;
  test.p_value = ranks.p_value;
  return test;
}

/// Tests a contrast of the median person in all conditions at once.
class HierarchicalTest {
 public:
  HierarchicalTest(const StudyData& data, const PlannedContrast& plan,
                   const ContrastConditions& conditions)
      : plan_(plan) {
    for (const ParticipantData& participant : data.participants) {
      if (const auto group = group_of(participant, conditions)) {
        groups_[participant.participant] = static_cast<int>(*group);
      }
    }
    std::vector<DiscriminationAnswers> everything;
    for (std::size_t at = 0; at < conditions.conditions.size(); ++at) {
      std::map<int, int> num_people;
      std::map<int, std::vector<AnswerCount>> rows;
      for (DiscriminationAnswers& one : condition_answers(data, conditions.conditions[at])) {
        const auto group = groups_.find(one.participant);
        if (group == groups_.end()) continue;
        ++num_people[group->second];
        const std::string& of_group =
            conditions.groups[static_cast<std::size_t>(group->second)].name;
        const std::string& name = conditions.conditions[at].name;
        const std::string condition = of_group.empty() ? name : name + ", " + of_group;
        weights_[condition] = conditions.weights[static_cast<std::size_t>(group->second)][at];
        answers_.push_back({one.participant, condition, one.reference, one.rows()});
        std::ranges::copy(one.rows(), std::back_inserter(rows[group->second]));
        everything.push_back(std::move(one));
      }
      for (std::size_t group = 0; group < conditions.groups.size(); ++group) {
        const auto place = static_cast<int>(group);
        const int num = num_people.contains(place) ? num_people.at(place) : 0;
        if (conditions.weights[group][at] != 0.0) {
          find_lack(conditions.conditions[at].name, conditions.groups[group].name, num,
                    rows[place]);
        }
        const auto [known, is_new] = num_people_.emplace(place, num);
        if (!is_new) known->second = std::min(known->second, num);
      }
    }
    num_conditions_ = weights_.size();
    pse_ = primary_pse(everything);
    is_paired_ = num_conditions_ == 2 && conditions.groups.size() == 1;
  }

  /// Whether the model takes so many conditions; where one is empty, nothing is to be fitted.
  [[nodiscard]] bool is_possible() const {
    if (!lack_.empty()) return true;
    return num_conditions_ >= 2 &&
           num_conditions_ <= (pse_ == HierarchicalPse::kPersonal ? std::size_t{4} : 8);
  }

  [[nodiscard]] ContrastTest test(std::optional<EffectEstimate>& estimate,
                                  std::vector<std::string>& cautions) const {
    if (!lack_.empty()) {
      return {.method = said("hierarchical fit"),
              .num_participants = static_cast<int>(groups_.size()),
              .reason = lack_};
    }
    const HierarchicalFit fit = fit_hierarchical(
        answers_,
        {.pse = pse_,
         .slopes = is_paired_ ? HierarchicalSlopes::kCorrelated : HierarchicalSlopes::kShared,
         .lapse_profile = false});
    const auto number = plan_.measure == ContrastMeasure::kPse
                            ? HierarchicalNumber::kLogPse
                            : HierarchicalNumber::kLogWeberFraction;
    estimate = hierarchical_contrast(fit, HierarchicalLink::kLogSlope, number, weights_,
                                     groups_, num_people_);
    std::string method =
        fit.method.empty() ? said("hierarchical fit") : said_composed(fit.method);
    for (const HierarchicalCondition& one : fit.conditions) {
      for (const std::string& caution : one.cautions) {
        cautions.push_back(one.condition + ": " + caution);
      }
    }
    return test_of(plan_, estimate, said("median person, {}", method), fit.num_participants,
                   fit.reason.empty() ? kTooFew : fit.reason);
  }

 private:
  /// What a condition lacks to have a number: people, or answers of both kinds for a pse.
  void find_lack(const std::string& condition, const std::string& group, int num_people,
                 const std::vector<AnswerCount>& rows) {
    if (!lack_.empty()) return;
    const std::string where = group.empty() ? condition : condition + ", " + group;
    if (num_people == 0) {
      lack_ = said("not estimable: nobody has answers in {}", where);
    } else if (plan_.measure == ContrastMeasure::kPse && all_alike(rows)) {
      lack_ = said("not estimable: there is no pse in {}, where all answers are alike", where);
    }
  }

  const PlannedContrast& plan_;
  std::string lack_;  ///< Why there is no value; "" if nothing is missing.
  std::vector<ParticipantAnswers> answers_;
  std::map<std::string, double> weights_;
  std::map<std::string, int> groups_;
  std::map<int, int> num_people_;
  std::size_t num_conditions_ = 0;
  HierarchicalPse pse_ = HierarchicalPse::kPersonal;
  bool is_paired_ = false;
};

/// A group that has a weight and nobody with answers; "" for none.
std::string absent_group(const StudyData& data, const ContrastConditions& conditions) {
  for (std::size_t group = 0; group < conditions.groups.size(); ++group) {
    if (conditions.groups[group].name.empty()) continue;  // Everybody.
    const bool has_weight = std::ranges::any_of(conditions.weights[group],
                                                [](double weight) { return weight != 0.0; });
    const bool is_there =
        std::ranges::any_of(data.participants, [&](const ParticipantData& participant) {
          return group_of(participant, conditions) == group && !participant.trials.empty();
        });
    if (has_weight && !is_there) return conditions.groups[group].name;
  }
  return "";
}

ContrastResult result_of(const StudyData& data, const PlannedContrast& plan) {
  ContrastResult result{.plan = plan};
  if (!data.written.languages.empty()) {
    const auto words = plan.hypothesis.find(data.written.languages.front());
    if (words != plan.hypothesis.end()) result.hypothesis = words->second;
  }
  const ContrastConditions conditions = contrast_conditions(data.written, plan);
  if (!conditions.problem.empty()) {
    result.test.reason = conditions.problem;
    return result;
  }
  result.conditions = condition_words(conditions);
  if (const std::string absent = absent_group(data, conditions); !absent.empty()) {
    result.test.reason = said("not estimable: nobody is in the group {}", absent);
    return result;
  }
  const Scores scores =
      scores_of(own_contrasts(condition_numbers(data, plan, conditions), conditions),
                conditions.groups.size(), plan);
  const std::string numbers = own_number_words(plan.measure);
  const std::optional<EffectEstimate> of_people = contrast_estimate(scores.by_group);
  ContrastTest own =
      test_of(plan, of_people, said("{} in {}", people_words(conditions), numbers),
              scores.num_participants, kTooFew);
  if (plan.measure == ContrastMeasure::kWeberFraction) {
    own.method += said("; its effect is a ratio of ln(1 + w)");
  }
  std::optional<EffectEstimate> answer = of_people;
  const bool is_fitted =
      plan.measure == ContrastMeasure::kWeberFraction || plan.measure == ContrastMeasure::kPse;
  result.excluded = scores.excluded;
  if (is_fitted) {
    const HierarchicalTest hierarchical(data, plan, conditions);
    if (hierarchical.is_possible()) {
      answer.reset();
      result.test = hierarchical.test(answer, result.cautions);
      result.otherwise.push_back(std::move(own));
    } else {
      result.test = std::move(own);
      result.cautions.emplace_back(
          said("the hierarchical fit does not take so many conditions; the answer is by "
               "people's own fits"));
    }
  } else {
    result.test = std::move(own);
  }
  if (auto ranks = by_ranks(plan, scores, numbers)) {
    result.otherwise.push_back(std::move(*ranks));
  }
  if (plan.smallest_effect && answer) result.equivalence = equivalence_of(plan, *answer);
  return result;
}

/// Adjusts the p values within each family.
void adjust(std::vector<ContrastResult>& results) {
  std::set<std::string> families;
  for (const ContrastResult& one : results) families.insert(one.plan.family);
  for (const std::string& family : families) {
    std::vector<ContrastResult*> members;
    std::vector<std::optional<double>> p_values;
    for (ContrastResult& one : results) {
      if (one.plan.family != family) continue;
      members.push_back(&one);
      p_values.push_back(one.test.p_value);
    }
    switch (members.front()->plan.correction) {
      case experiments::Correction::kHolm:
        p_values = holm_adjusted(p_values);
        break;
      case experiments::Correction::kBonferroni:
        p_values = bonferroni_adjusted(p_values);
        break;
      case experiments::Correction::kNone:
        break;
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      members[i]->p_value_adjusted = p_values[i];
    }
  }
}

}  // namespace

Tail tail_of(const PlannedContrast& plan) {
  return plan.direction == ContrastDirection::kGreater ? Tail::kGreater
         : plan.direction == ContrastDirection::kLess  ? Tail::kLess
                                                       : Tail::kTwoSided;
}

std::optional<double> told_effect(const PlannedContrast& plan,
                                  const std::optional<double>& value) {
  if (!value) return std::nullopt;
  const double effect = is_ratio(plan.measure) ? std::exp(*value) : *value;
  return std::isfinite(effect) ? std::optional(effect) : std::nullopt;
}

std::string own_number_words(ContrastMeasure measure) {
  switch (measure) {
    case ContrastMeasure::kWeberFraction:
      return "ln ln(1 + w)";
    case ContrastMeasure::kPse:
      return said("ln(pse / reference)");
    case ContrastMeasure::kExponent:
      return said("exponents");
    case ContrastMeasure::kMagnitude:
      return said("mean ln magnitudes");
    case ContrastMeasure::kMatch:
      return said("mean ln matches");
    case ContrastMeasure::kRating:
      return said("mean ratings");
    case ContrastMeasure::kQuestion:
      return said("mean answers");
    case ContrastMeasure::kResponseTime:
      return said("mean ln response times");
  }
  return "";
}

OwnContrasts own_contrasts(const ConditionNumbers& numbers,
                           const ContrastConditions& conditions) {
  OwnContrasts own{.participants = numbers.participants};
  for (std::size_t person = 0; person < numbers.participants.size(); ++person) {
    const auto group =
        static_cast<std::size_t>(std::ranges::find(conditions.groups, numbers.groups[person],
                                                   &experiments::ContrastGroup::name) -
                                 conditions.groups.begin());
    PersonScore score{.group = group};
    std::string lacking;
    for (std::size_t at = 0; at < conditions.conditions.size(); ++at) {
      const std::optional<double>& number = numbers.numbers[person][at];
      if (!number) {
        lacking = conditions.conditions[at].name;
        break;
      }
      score.score += conditions.weights[group][at] * *number;
    }
    own.scores.push_back(lacking.empty() ? std::optional(score) : std::nullopt);
    own.lacking.push_back(std::move(lacking));
  }
  return own;
}

std::vector<ContrastResult> planned_contrasts(const StudyData& data) {
  std::vector<ContrastResult> results;
  for (const PlannedContrast& plan : data.written.contrasts) {
    results.push_back(result_of(data, plan));
  }
  adjust_for_looks(results, data);
  adjust(results);
  for (ContrastResult& one : results) {
    one.sentence = contrast_sentence(one);
    const bool is_of_times = one.plan.measure == ContrastMeasure::kResponseTime;
    if (!is_of_times || !data.simulated || one.sentence.empty()) continue;
    // The remark stands wherever the test is reported. The times of simulated people are the
    // times of their strokes.
    one.sentence +=
        said(" The people are SIMULATED: how long they take says nothing about people.");
  }
  return results;
}

}  // namespace jnd::analysis
