#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/data/cell_arms.h"
#include "analysis/data/magnitude_means.h"
#include "analysis/results/contrast_answers.h"
#include "analysis/results/magnitude_fits.h"
#include "analysis/results/planned_contrasts.h"
#include "analysis/statistics/summary.h"
#include "experiments/study/question_answer.h"

namespace jnd::analysis {
namespace {

using experiments::ContrastMeasure;

using Trials = std::vector<core::TrialRow>;

Trials trials_of(const ParticipantData& participant, const std::vector<std::string>& blocks) {
  Trials trials;
  for (const std::string& block : blocks) {
    const Trials more = participant.trials_in(block);
    trials.insert(trials.end(), more.begin(), more.end());
  }
  return trials;
}

MagnitudeAnswers answers_at(const Trials& trials, std::optional<double> core::TrialRow::*x) {
  MagnitudeAnswers answers;
  for (const core::TrialRow& trial : trials) {
    if (trial.*x && trial.response) answers[*(trial.*x)].push_back(*trial.response);
  }
  return answers;
}

std::optional<double> mean_over(const Means& means) {
  std::vector<double> values;
  for (const auto& [x, mean] : means) values.push_back(mean);
  return summary_of(values).mean;
}

std::optional<double> exponent_of(const Trials& trials) {
  if (trials.front().target_percent) {
    return fit_own_intensity_on_magnitude(answers_at(trials, &core::TrialRow::target_percent))
        .a;
  }
  const MagnitudeAnswers answers = answers_at(trials, &core::TrialRow::intensity);
  return fit_log_estimation(means_of(log_answers(answers, ZeroRule::kHalfSmallest).logs)).a;
}

/// The mean answer to a question after the valid trials of these blocks, including catch
/// trials.
std::optional<double> mean_answer(const ParticipantData& participant,
                                  const std::vector<std::string>& blocks,
                                  const std::string& question) {
  std::set<std::pair<std::int64_t, std::int64_t>> counted;
  for (const auto* const list : {&participant.trials, &participant.catch_trials}) {
    for (const core::TrialRow& trial : *list) {
      if (std::ranges::find(blocks, trial.block) == blocks.end()) continue;
      counted.insert({trial.session, trial.trial});
    }
  }
  std::vector<double> values;
  for (const core::QuestionAnswerRow& row : participant.question_answers) {
    if (row.question != question || !counted.contains({row.session, row.trial})) continue;
    if (const auto value = experiments::value_of_answer(row.answer)) values.push_back(*value);
  }
  return summary_of(values).mean;
}

std::optional<double> log_response_time(const Trials& trials) {
  std::vector<double> logs;
  for (const core::TrialRow& trial : trials) {
    if (trial.measures.response_time_s.value_or(0.0) > 0.0) {
      logs.push_back(std::log(*trial.measures.response_time_s));
    }
  }
  return summary_of(logs).mean;
}

std::optional<double> number_of(const Trials& trials, ContrastMeasure measure) {
  if (trials.empty()) return std::nullopt;
  switch (measure) {
    case ContrastMeasure::kExponent:
      return exponent_of(trials);
    case ContrastMeasure::kMagnitude:
      return mean_over(means_of(
          log_answers(answers_at(trials, &core::TrialRow::intensity), ZeroRule::kHalfSmallest)
              .logs));
    case ContrastMeasure::kMatch:
      return mean_over(
          means_of(log_answers(answers_at(trials, &core::TrialRow::reference_intensity),
                               ZeroRule::kLeaveOut)
                       .logs));
    case ContrastMeasure::kRating:
      return mean_over(means_of(answers_at(trials, &core::TrialRow::intensity)));
    case ContrastMeasure::kResponseTime:
      return log_response_time(trials);
    case ContrastMeasure::kQuestion:
    case ContrastMeasure::kWeberFraction:
    case ContrastMeasure::kPse:
      break;
  }
  return std::nullopt;
}

std::optional<double> number_of(const DiscriminationAnswers& answers, ContrastMeasure measure,
                                bool free_pse) {
  const PsychometricFit plain = own_fit(answers, {.free_pse = free_pse});
  if (measure == ContrastMeasure::kPse) {
    if (!plain.pse || !(*plain.pse > 0.0)) return std::nullopt;
    return std::log(*plain.pse / answers.reference);
  }
  std::optional<double> fraction = plain.weber_fraction;
  if (!fraction) {
    fraction = own_fit(answers, {.corrected = true, .free_pse = free_pse}).weber_fraction;
  }
  const double number = fraction ? std::log(std::log1p(*fraction)) : NAN;
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<std::size_t> group_of(const ParticipantData& participant,
                                    const experiments::ContrastConditions& conditions) {
  const std::map<std::string, std::string> arms = arms_of(participant.cells);
  for (std::size_t group = 0; group < conditions.groups.size(); ++group) {
    const bool is_its =
        std::ranges::all_of(conditions.groups[group].levels, [&](const auto& level) {
          const auto arm = arms.find(level.first);
          return arm != arms.end() && arm->second == level.second;
        });
    if (is_its) return group;
  }
  return std::nullopt;
}

std::vector<DiscriminationAnswers> condition_answers(
    const StudyData& data, const experiments::ContrastCondition& condition) {
  std::vector<DiscriminationAnswers> all;
  std::vector<ExcludedParticipant> unnamed;
  for (const BlockDesign& block : data.blocks) {
    if (std::ranges::find(condition.blocks, block.block) == condition.blocks.end()) continue;
    for (DiscriminationAnswers& more : discrimination_answers(data, block, false, unnamed)) {
      const auto known =
          std::ranges::find(all, more.participant, &DiscriminationAnswers::participant);
      if (known == all.end()) {
        all.push_back(std::move(more));
        continue;
      }
      const auto add = [](auto& into, const auto& from) {
        for (const auto& [key, count] : from) {
          AnswerCount& sum = into[key];
          sum.intensity = count.intensity;
          sum.order = count.order;
          sum.num_yes += count.num_yes;
          sum.num_trials += count.num_trials;
        }
      };
      add(known->levels, more.levels);
      add(known->cells, more.cells);
    }
  }
  return all;
}

ConditionNumbers condition_numbers(const StudyData& data,
                                   const experiments::PlannedContrast& plan,
                                   const experiments::ContrastConditions& conditions) {
  const ContrastMeasure measure = plan.measure;
  const bool is_fitted =
      measure == ContrastMeasure::kWeberFraction || measure == ContrastMeasure::kPse;
  std::vector<std::vector<DiscriminationAnswers>> answers;
  std::vector<DiscriminationAnswers> everything;
  if (is_fitted) {
    for (const experiments::ContrastCondition& condition : conditions.conditions) {
      answers.push_back(condition_answers(data, condition));
      everything.insert(everything.end(), answers.back().begin(), answers.back().end());
    }
  }
  const bool free_pse = is_fitted && primary_pse(everything) == HierarchicalPse::kPersonal;
  ConditionNumbers own;
  for (const ParticipantData& participant : data.participants) {
    const std::optional<std::size_t> group = group_of(participant, conditions);
    if (!group) continue;
    own.participants.push_back(participant.participant);
    own.groups.push_back(conditions.groups[*group].name);
    std::vector<std::optional<double>>& numbers = own.numbers.emplace_back();
    for (std::size_t at = 0; at < conditions.conditions.size(); ++at) {
      const std::vector<std::string>& blocks = conditions.conditions[at].blocks;
      if (measure == ContrastMeasure::kQuestion) {
        numbers.push_back(mean_answer(participant, blocks, plan.question));
        continue;
      }
      if (!is_fitted) {
        numbers.push_back(number_of(trials_of(participant, blocks), measure));
        continue;
      }
      const auto found = std::ranges::find(answers[at], participant.participant,
                                           &DiscriminationAnswers::participant);
      numbers.push_back(found == answers[at].end() ? std::nullopt
                                                   : number_of(*found, measure, free_pse));
    }
  }
  return own;
}

}  // namespace jnd::analysis
