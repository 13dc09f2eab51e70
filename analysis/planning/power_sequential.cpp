#include "analysis/planning/power_sequential.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "analysis/results/number_words.h"
#include "analysis/statistics/wilson_interval.h"
#include "core/require.h"

namespace jnd::analysis {

SequentialRun sequential_run(const PlannedSequential& planned,
                             const std::vector<std::optional<PersonScore>>& people,
                             std::size_t num_groups) {
  const SequentialRule& rule = planned.boundaries.rule;
  std::vector<std::optional<EffectEstimate>> estimates;
  for (const int look : rule.looks) {
    estimates.push_back(estimate_of_first(people, static_cast<std::size_t>(look), num_groups));
  }
  const SequentialOutcome outcome = sequential_outcome(planned.boundaries, estimates);
  SequentialRun run{.look = outcome.estimates.size() - 1, .significant = outcome.significant};
  for (int num = rule.looks.front(); num <= rule.looks.back(); ++num) {
    const auto fixed = estimate_of_first(people, static_cast<std::size_t>(num), num_groups);
    run.fixed_significant.push_back(fixed && p_value_of(*fixed, rule.tail) < rule.alpha);
  }
  return run;
}

std::optional<SequentialPower> sequential_power(const std::optional<PlannedSequential>& planned,
                                                const std::vector<SequentialRun>& runs) {
  if (!planned) return std::nullopt;
  core::require(!runs.empty(), "runs", "a number >= 1", 0.0);
  const std::vector<int>& looks = planned->boundaries.rule.looks;
  SequentialPower power{.num_runs = static_cast<std::int64_t>(runs.size()),
                        .num_ended = std::vector<std::int64_t>(looks.size()),
                        .num_significant = std::vector<std::int64_t>(looks.size())};
  const auto num_runs = static_cast<double>(runs.size());
  std::vector<std::int64_t> fixed(static_cast<std::size_t>(looks.back() - looks.front() + 1));
  std::int64_t num_significant = 0;
  double sum = 0.0, squares = 0.0;
  for (const SequentialRun& run : runs) {
    ++power.num_ended.at(run.look);
    power.num_significant.at(run.look) += run.significant ? 1 : 0;
    num_significant += run.significant ? 1 : 0;
    const double num_people = looks.at(run.look);
    sum += num_people;
    squares += num_people * num_people;
    for (std::size_t i = 0; i < fixed.size(); ++i) {
      fixed[i] += run.fixed_significant.at(i) ? 1 : 0;
    }
  }
  power.power = static_cast<double>(num_significant) / num_runs;
  std::tie(power.power_low, power.power_high) =
      wilson_interval(num_significant, power.num_runs);
  power.mean_participants = sum / num_runs;
  const double variance =
      squares / num_runs - power.mean_participants * power.mean_participants;
  power.standard_error = std::sqrt(std::max(0.0, variance) / num_runs);
  power.fixed_power = static_cast<double>(fixed.back()) / num_runs;
  for (std::size_t i = 0; i < fixed.size() && !power.fixed_participants; ++i) {
    if (fixed[i] >= num_significant) {
      power.fixed_participants = looks.front() + static_cast<int>(i);
    }
  }
  return power;
}

std::string sequential_doubt(const PlannedSequential& planned, const SequentialPower& power) {
  const double alpha = planned.boundaries.rule.alpha;
  if (power.power_low <= alpha) return "";
  return planned.contrast +
         ": by its looks the study finds a difference where there is none in " +
         number_words(100.0 * power.power, 1) + " % of the runs, and at most " +
         number_words(100.0 * alpha, 1) +
         " % were to be: here the t test of people's own contrasts errs more often than it "
         "should, "
         "as it does where blocks are not measured alike or people spread unevenly; compare it "
         "with the test without looks, and plan other stimuli or a later first look.";
}

}  // namespace jnd::analysis
