#include "analysis/data/adaptive_runs.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "experiments/adaptive/level_scale.h"
#include "experiments/procedures/adaptive_trial.h"
#include "experiments/procedures/limits_procedure.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/procedures/quest_plus_procedure.h"
#include "experiments/procedures/staircase_procedure.h"

namespace jnd::analysis {
namespace {

using namespace experiments;

/// A trial that moved the procedure, with its place in the block.
struct LevelTrial {
  std::int64_t number = 0;  ///< The number within the block, from 1.
  int series = 0;           ///< The series; 0 if there is only one.
  LevelAnswer answer;
  bool set_aside = false;
};

std::vector<LevelTrial> level_trials(const std::vector<core::TrialRow>& rows,
                                     const std::vector<bool>& set_aside) {
  std::vector<LevelTrial> trials;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const core::TrialRow& row = rows[i];
    if (row.is_catch || !row.intensity || !row.response) continue;
    trials.push_back({.number = static_cast<std::int64_t>(i) + 1,
                      .series = static_cast<int>(row.series.value_or(0)),
                      .answer = {*row.intensity, *row.response > 0.5},
                      .set_aside = set_aside[i]});
  }
  return trials;
}

std::vector<LevelAnswer> answers_of(const std::vector<LevelTrial>& trials) {
  std::vector<LevelAnswer> answers;
  for (const LevelTrial& trial : trials) answers.push_back(trial.answer);
  return answers;
}

std::vector<LevelTrial> of_series(const std::vector<LevelTrial>& trials, int series) {
  std::vector<LevelTrial> own;
  std::ranges::copy_if(trials, std::back_inserter(own),
                       [series](const LevelTrial& trial) { return trial.series == series; });
  return own;
}

AdaptiveTrack track_of(int series, const std::vector<LevelTrial>& trials) {
  AdaptiveTrack track{.series = series};
  for (const LevelTrial& trial : trials) {
    track.points.push_back(
        {.trial = trial.number, .level = trial.answer.level, .yes = trial.answer.yes});
  }
  return track;
}

AdaptiveTrack staircase_track(const Staircase& staircase, int series,
                              const std::vector<LevelTrial>& trials) {
  AdaptiveTrack track = track_of(series, trials);
  const StaircaseState state = staircase.after(answers_of(trials));
  const StaircaseThreshold threshold = staircase.threshold(state);
  track.threshold = threshold.level;
  track.num_reversals = threshold.num_reversals;
  track.num_at_bound = threshold.num_at_bound;
  const std::size_t first =
      state.reversals.size() - static_cast<std::size_t>(threshold.num_reversals);
  for (std::size_t i = 0; i < state.reversals.size(); ++i) {
    TrackPoint& point = track.points.at(state.reversals[i].trial);
    point.is_reversal = true;
    point.is_averaged = i >= first;
  }
  return track;
}

std::string rule_words(const StaircaseRule& rule) {
  std::string words =
      std::to_string(rule.num_up) + " up, " + std::to_string(rule.num_down) + " down";
  if (rule.down_per_up_ratio != 1.0) {
    std::string ratio = std::to_string(rule.down_per_up_ratio);
    ratio.erase(ratio.find_last_not_of('0') + 1);
    if (ratio.ends_with('.')) ratio.pop_back();
    return words + ", steps down " + ratio + " times those up; Kaernbach 1991";
  }
  return words + "; Levitt 1971";
}

void run_staircases(const Block& block, const std::vector<LevelTrial>& trials,
                    AdaptiveRun& run) {
  const auto count = static_cast<int>(block.settings.numbers("start").size());
  std::vector<double> thresholds;
  LevelScale scale = LevelScale::kLinear;
  for (int series = 1; series <= count; ++series) {
    const Staircase staircase(staircase_rule_of(block, series));
    scale = staircase.rule().scale;
    run.rule = rule_words(staircase.rule());
    run.target_probability = staircase.target_probability();
    run.tracks.push_back(staircase_track(staircase, series, of_series(trials, series)));
    if (run.tracks.back().threshold) thresholds.push_back(*run.tracks.back().threshold);
  }
  run.is_logarithmic = scale == LevelScale::kLogarithmic;
  if (!thresholds.empty()) run.threshold = mean_level(scale, thresholds);
}

/// The series that begins with this level. Ascending and descending series begin in different
/// halves of the levels.
PlannedSeries planned_series(const LimitsRule& rule, double first_level) {
  const auto start = static_cast<std::size_t>(
      std::ranges::lower_bound(rule.levels, first_level) - rule.levels.begin());
  const bool rises = start < rule.levels.size() / 2;
  return {rises ? SeriesDirection::kAscending : SeriesDirection::kDescending, start};
}

void run_limits(const Block& block, const std::vector<LevelTrial>& trials, AdaptiveRun& run) {
  const Limits limits(limits_rule_of(block));
  std::vector<PlannedSeries> plan;
  std::vector<LevelAnswer> answers;
  for (int series = 1; series <= limits.rule().num_series; ++series) {
    const std::vector<LevelTrial> own = of_series(trials, series);
    if (own.empty()) break;
    plan.push_back(planned_series(limits.rule(), own.front().answer.level));
    run.tracks.push_back(track_of(series, own));
    run.tracks.back().direction =
        plan.back().direction == SeriesDirection::kAscending ? "ascending" : "descending";
    for (const LevelTrial& trial : own) answers.push_back(trial.answer);
  }
  const LimitsState state = limits.after(plan, answers);
  for (std::size_t i = 0; i < state.series.size(); ++i) {
    run.tracks[i].threshold = state.series[i].transition;
  }
  const LimitsThreshold found = limits.threshold(state);
  run.is_logarithmic = limits.rule().scale == LevelScale::kLogarithmic;
  run.threshold = found.level;
  run.limits = {found.ascending, found.descending, found.constant_error, found.num_ascending,
                found.num_descending};
}

void run_quest_plus(const Block& block, const std::vector<LevelTrial>& trials,
                    AdaptiveRun& run) {
  const QuestPlus quest(quest_plus_rule_of(block));
  std::vector<LevelTrial> standing;
  std::ranges::copy_if(trials, std::back_inserter(standing),
                       [](const LevelTrial& trial) { return !trial.set_aside; });
  run.is_logarithmic = true;
  run.tracks.push_back(track_of(1, trials));
  const std::vector<QuestPlusEstimate> estimates =
      quest.estimates(quest.posterior(answers_of(standing)));
  run.reached_ends = reached_ends(block, estimates);
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    // The parameter was taken as known.
    if (quest.rule().model.parameters[i].grid.values.size() == 1) continue;
    const QuestPlusEstimate& one = estimates[i];
    run.posterior.push_back({one.name, one.mean, one.sd, one.low, one.high});
    if (!run.reached_ends.empty()) run.posterior.back().low = run.posterior.back().high = {};
  }
}

struct BlockTrials {
  std::vector<core::TrialRow> rows;
  std::vector<bool> set_aside;
};

/// A participant's trials in a block, by session and in their order.
std::map<std::int64_t, BlockTrials> trials_by_session(const ParticipantData& participant,
                                                      const std::string& block) {
  std::vector<std::pair<core::TrialRow, bool>> all;
  for (const core::TrialRow& row : participant.trials) all.emplace_back(row, false);
  for (const core::TrialRow& row : participant.catch_trials) all.emplace_back(row, false);
  for (const core::TrialRow& row : participant.excluded_trials) all.emplace_back(row, true);
  std::ranges::sort(all, {}, [](const auto& one) { return one.first.trial; });
  std::map<std::int64_t, BlockTrials> sessions;
  for (auto& [row, set_aside] : all) {
    if (row.block != block) continue;
    BlockTrials& own = sessions[row.session];
    own.set_aside.push_back(set_aside);
    own.rows.push_back(std::move(row));
  }
  return sessions;
}

}  // namespace

AdaptiveRun adaptive_run_of(const Block& block, const std::vector<core::TrialRow>& trials,
                            const std::vector<bool>& set_aside) {
  AdaptiveRun run{.procedure = block.procedure,
                  .num_set_aside = static_cast<int>(std::ranges::count(set_aside, true))};
  const std::vector<LevelTrial> own = level_trials(trials, set_aside);
  if (own.empty()) {
    run.problem = "no answers";
    return run;
  }
  try {
    switch (procedure_named(block.procedure).rule()) {
      case AdaptiveRule::kStaircase:
        run_staircases(block, own, run);
        break;
      case AdaptiveRule::kLimits:
        run_limits(block, own, run);
        break;
      case AdaptiveRule::kQuestPlus:
        run_quest_plus(block, own, run);
        break;
      case AdaptiveRule::kNone:
        break;
    }
  } catch (const core::Error& error) {
    run.problem = std::string("the answers do not follow the block's rule, ") + error.what();
  }
  return run;
}

void add_adaptive_runs(StudyData& data) {
  for (const BlockDesign& design : data.blocks) {
    if (!design.is_adaptive()) continue;
    for (const ParticipantData& participant : data.participants) {
      for (const auto& [session, trials] : trials_by_session(participant, design.block)) {
        AdaptiveRun run{.procedure = design.procedure};
        try {
          run = adaptive_run_of(design.written, trials.rows, trials.set_aside);
        } catch (const std::logic_error& error) {
          run.problem = std::string("its study file lacks a key of the rule, ") + error.what();
        }
        run.participant = participant.participant;
        run.block = design.block;
        data.runs.push_back(std::move(run));
      }
    }
  }
}

}  // namespace jnd::analysis
