#include "analysis/results/exploratory_results.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "analysis/data/cell_arms.h"
#include "analysis/data/running_numbers.h"
#include "analysis/results/magnitude_section.h"
#include "analysis/results/test_families.h"
#include "analysis/statistics/within_slope.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

/// The trials of one block with their running numbers, in the order in which they were run.
using Trials = std::vector<core::TrialRow>;
using Points = std::vector<GroupedPoint>;

/// An effect within each participant.
struct Effect {
  std::string name;
  std::string meaning;
  std::string unit;
  std::function<std::optional<double>(const Trials&)> of_one;
};

/// For productions: the slope of the set value over the starting value, within each target.
std::optional<double> starting_value_slope(const Trials& trials) {
  Points points;
  for (const core::TrialRow& trial : trials) {
    if (!trial.target_percent || !trial.starting_intensity || !trial.response) continue;
    points.push_back(
        {{trial.session, *trial.target_percent}, *trial.starting_intensity, *trial.response});
  }
  return within_slope(points);
}

/// Answers divided by their own mean for the same stimulus or target, minus 1. `x_of` gives
/// their x from the trial and the one before it in the block (null for the first). Free space
/// is left out, because a ratio to almost nothing has no meaning.
template <typename XOf>
Points relative_answers(const Trials& trials, std::optional<double> core::TrialRow::*stimulus,
                        const XOf& x_of) {
  std::map<double, std::pair<double, int>> sums;
  for (const core::TrialRow& trial : trials) {
    if (!(trial.*stimulus) || !trial.response) continue;
    sums[*(trial.*stimulus)].first += *trial.response;
    ++sums[*(trial.*stimulus)].second;
  }
  Points points;
  const core::TrialRow* before = nullptr;
  for (const core::TrialRow& trial : trials) {
    const core::TrialRow* previous = std::exchange(before, &trial);
    if (!(trial.*stimulus) || !trial.response || !(*(trial.*stimulus) > 0.0)) continue;
    const auto& [sum, num] = sums[*(trial.*stimulus)];
    const bool follows = previous != nullptr && previous->session == trial.session &&
                         previous->trial + 1 == trial.trial;
    const std::optional<double> x = x_of(trial, follows ? previous : nullptr);
    if (!x || !(sum > 0.0)) continue;
    points.push_back(
        {{trial.session, *(trial.*stimulus)}, *x, *trial.response * num / sum - 1.0});
  }
  return points;
}

std::optional<double> drift_per_ten_trials(const Trials& trials,
                                           std::optional<double> core::TrialRow::*stimulus) {
  const auto slope = within_slope(
      relative_answers(trials, stimulus, [](const core::TrialRow& trial, const auto*) {
        return std::optional(0.1 * static_cast<double>(trial.trial));
      }));
  return slope;
}

std::optional<double> previous_stimulus_slope(const Trials& trials) {
  return within_slope(
      relative_answers(trials, &core::TrialRow::intensity,
                       [](const core::TrialRow&, const core::TrialRow* previous) {
                         return previous != nullptr ? previous->intensity : std::nullopt;
                       }));
}

std::vector<Effect> effects_of(const BlockDesign& block) {
  const std::string unit = experiments::unit_of_quantity(block.quantity);
  if (block.produces()) {
    return {
        {"starting_value_slope",
         said("how far the set value follows the starting value of the adjustment, within a "
              "target: 0 not at all, 1 wholly"),
         "1", starting_value_slope},
        {"drift_per_ten_trials",
         said("change of the set value over ten trials, relative to its mean for the target"),
         "1", [](const Trials& trials) {
           return drift_per_ten_trials(trials, &core::TrialRow::target_percent);
         }}};
  }
  if (block.estimates()) {
    return {
        {"drift_per_ten_trials",
         said("change of the answer over ten trials, relative to its mean for the stimulus"),
         "1",
         [](const Trials& trials) {
           return drift_per_ten_trials(trials, &core::TrialRow::intensity);
         }},
        {"previous_stimulus_slope",
         said("change of the answer, relative to its mean for the stimulus, with the intensity "
              "of the stimulus before: above 0 they are drawn together, below 0 set apart"),
         unit == "1" ? "1" : "1/(" + unit + ")", previous_stimulus_slope}};
  }
  return {};
}

void add_tests(ResultsSection& section, const std::string& name, Comparison t, Comparison ranks,
               const std::string& ratio_of = "") {
  section.comparisons.push_back({.name = name + ", t",
                                 .comparison = std::move(t),
                                 .family = kEffectsFamily,
                                 .ratio_of = ratio_of});
  section.comparisons.push_back({.name = said("{}, ranks, sensitivity", name),
                                 .comparison = std::move(ranks),
                                 .ratio_of = ratio_of});
}

void add_effect(ResultsSection& section, const StudyData& data, const BlockDesign& block,
                const Effect& effect) {
  const std::string name = block.block + "." + effect.name;
  std::vector<double> values;
  for (const ParticipantData& participant : data.participants) {
    Trials trials = participant.trials_in(block.block);
    if (trials.empty()) continue;
    const auto numbers = running_numbers(participant, block.block);
    for (core::TrialRow& trial : trials) trial.trial = numbers.at({trial.session, trial.trial});
    std::ranges::sort(trials, {}, [](const core::TrialRow& trial) {
      return std::pair(trial.session, trial.trial);
    });
    const std::optional<double> own = effect.of_one(trials);
    section.participants.push_back(
        {participant.participant,
         name,
         own,
         {},
         own ? "" : said("too few answers that tell the two apart")});
    if (own) values.push_back(*own);
  }
  if (values.empty()) return;
  add_mean(section, name, said("exploratory: {}; mean of the participants", effect.meaning),
           values, effect.unit);
  add_tests(section, said("{} against 0", name), one_sample_t_test(values),
            wilcoxon_test(values, std::vector<double>(values.size(), 0.0)));
}

/// A parameter that every participant has, on a scale on which people spread evenly.
struct Outcome {
  std::string name;
  /// For a difference of logarithms: the quantity whose ratio its exponential is.
  std::string ratio_of{};
  std::map<std::string, double> by_participant{};
};

std::optional<double> on_even_scale(const std::string& parameter, double value) {
  const double result = parameter == "a"   ? value
                        : parameter == "k" ? std::log(value)
                                           : std::log(std::log1p(value));
  return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

std::vector<Outcome> outcomes_of(const StudyData& data,
                                 const std::vector<ResultsSection>& sections) {
  std::vector<Outcome> outcomes;
  for (const BlockDesign& block : data.blocks) {
    for (const auto& [parameter, words, ratio_of] :
         {std::tuple{"k", "ln k", "k"},
          {"a", "a", ""},
          {"weber_fraction", "ln ln(1 + w)", "ln(1 + w)"}}) {
      // With everybody's own numbers, k depends only on that choice.
      if (parameter == std::string("k") && block.counts_in_own_numbers()) continue;
      Outcome outcome{.name = said("{} of {}", std::string(words), block.block),
                      .ratio_of = ratio_of};
      for (const ResultsSection& section : sections) {
        for (const ParticipantEstimate& own : section.participants) {
          if (own.name != block.block + "." + parameter || !own.value) continue;
          const std::optional<double> value = on_even_scale(parameter, *own.value);
          if (value) outcome.by_participant[own.participant] = *value;
        }
      }
      if (!outcome.by_participant.empty()) outcomes.push_back(std::move(outcome));
    }
  }
  return outcomes;
}

/// The participants in each arm.
using Arms = std::map<std::string, std::vector<std::string>>;

Arms people_in(const StudyData& data, const std::string& counterbalance) {
  Arms people;
  for (const ParticipantData& participant : data.participants) {
    const auto arms = arms_of(participant.cells);
    const auto arm = arms.find(counterbalance);
    if (arm != arms.end()) people[arm->second].push_back(participant.participant);
  }
  return people;
}

/// Whether an arm is a row of a square, or one of many orders. These exist to balance the order
/// over people, and each has too few people to be compared. The order of two methods is
/// compared.
bool is_sequence(const std::string& arm) {
  constexpr std::string_view kRow = "row_";
  const bool is_row = arm.starts_with(kRow) &&
                      arm.find_first_not_of("0123456789", kRow.size()) == std::string::npos;
  return is_row || std::ranges::count(arm, ',') > 1;
}

void compare_arms(ResultsSection& section, const Arms& people, const Outcome& outcome,
                  const std::string& counterbalance) {
  std::map<std::string, std::vector<double>> by_arm;
  for (const auto& [arm, participants] : people) {
    for (const std::string& participant : participants) {
      const auto value = outcome.by_participant.find(participant);
      if (value != outcome.by_participant.end()) by_arm[arm].push_back(value->second);
    }
  }
  // A single person has no spread.
  std::erase_if(by_arm, [](const auto& arm) { return arm.second.size() < 2; });
  for (auto a = by_arm.begin(); a != by_arm.end(); ++a) {
    for (auto b = std::next(a); b != by_arm.end(); ++b) {
      add_tests(section,
                counterbalance + ": " + a->first + " - " + b->first + ": " + outcome.name,
                welch_t_test(a->second, b->second), rank_sum_test(a->second, b->second),
                outcome.ratio_of);
    }
  }
}

/// Says which arms are too small to be compared.
void name_small_arms(ResultsSection& section, const Arms& people,
                     const std::string& counterbalance) {
  if (people.size() < 2) return;
  for (const auto& [arm, participants] : people) {
    if (participants.size() > 1) continue;
    section.excluded.push_back(
        {participants.front(), said("{}: not compared, the only one in {} = {}", counterbalance,
                                    counterbalance, arm)});
  }
}

}  // namespace

ResultsSection exploratory_results(const StudyData& data,
                                   const std::vector<ResultsSection>& sections) {
  ResultsSection section{.name = "exploratory"};
  for (const BlockDesign& block : data.blocks) {
    for (const Effect& effect : effects_of(block)) add_effect(section, data, block, effect);
  }
  std::set<std::string> counterbalances;
  for (const ParticipantData& participant : data.participants) {
    for (const auto& [name, arm] : arms_of(participant.cells)) counterbalances.insert(name);
  }
  const std::vector<Outcome> outcomes = outcomes_of(data, sections);
  for (const std::string& counterbalance : counterbalances) {
    const Arms people = people_in(data, counterbalance);
    if (std::ranges::any_of(people, [](const auto& arm) { return is_sequence(arm.first); })) {
      continue;
    }
    for (const Outcome& outcome : outcomes) {
      compare_arms(section, people, outcome, counterbalance);
    }
    if (!outcomes.empty()) name_small_arms(section, people, counterbalance);
  }
  return section;
}

}  // namespace jnd::analysis
