#include "analysis/data/adaptive_runs.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "experiments/procedures/procedure_registry.h"

namespace jnd::analysis {
namespace {

using namespace experiments;

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
  AdaptiveRun run;
  run.procedure = block.procedure;
  run.num_set_aside = static_cast<int>(std::ranges::count(set_aside, true));
  const std::vector<LevelTrial> own = level_trials(trials, set_aside);
  if (own.empty()) {
    run.problem = "no answers";
    return run;
  }
  try {
    procedure_named(block.procedure).run(block, own, run);
    for (const AdaptiveTrack& track : run.tracks) {
      run.num_after_end +=
          static_cast<int>(std::ranges::count(track.points, true, &TrackPoint::is_after_end));
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
        AdaptiveRun run;
        run.procedure = design.procedure;
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
