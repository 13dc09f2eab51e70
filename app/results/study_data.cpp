#include "app/results/study_data.h"

#include <algorithm>
#include <map>

#include "analysis/results/threshold_results.h"
#include "app/results/adaptive_runs.h"
#include "app/session/session_setup.h"
#include "core/error.h"
#include "experiments/procedures/practice.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

using analysis::ParticipantData;
using experiments::AnsweredTrial;
using experiments::Block;
using experiments::PlannedTrial;
using experiments::PracticeState;
using experiments::Stage;

/// Blocks of the study files that sessions were begun with, each file read once.
class StoredBlocks {
 public:
  explicit StoredBlocks(const core::StudyStore& store) : store_(store) {
    for (const core::SessionRow& row : store.sessions()) sessions_[row.session] = row;
  }

  /// Nullptr for a block that the session's study has not.
  const Block* find(std::int64_t session, const std::string& name) {
    const core::SessionRow& row = sessions_.at(session);
    const auto [found, is_new] = studies_.try_emplace(row.protocol_sha256);
    if (is_new) found->second = stored_study(store_, session);
    for (const Stage* stage : stages_of_session(found->second, row.cells)) {
      if (stage->name == name) return std::get_if<Block>(&stage->content);
    }
    return nullptr;
  }

 private:
  const core::StudyStore& store_;
  std::map<std::int64_t, core::SessionRow> sessions_;
  std::map<std::string, experiments::Study> studies_;  // By SHA-256.
};

struct BlockTrials {
  std::vector<core::TrialRow> rows;
  std::vector<bool> set_aside;
};

/// A participant's trials in a block, session by session, in their order.
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

/// A study file that this program no longer reads is a problem of the run, not of the results.
analysis::AdaptiveRun run_of(StoredBlocks& blocks, std::int64_t session,
                             const analysis::BlockDesign& design, const BlockTrials& trials) {
  try {
    if (const Block* const block = blocks.find(session, design.block)) {
      return adaptive_run_of(*block, trials.rows, trials.set_aside);
    }
    return {.procedure = design.procedure, .problem = "its study file has no such block"};
  } catch (const core::Error& error) {
    return {.procedure = design.procedure, .problem = error.what()};
  }
}

/// One entry for each session of the participant and practice block that has trials in it.
void add_practice(analysis::StudyData& data, StoredBlocks& blocks,
                  const ParticipantData& participant) {
  std::map<std::pair<std::int64_t, std::string>, std::vector<AnsweredTrial>> answered;
  for (const core::TrialRow& row : participant.practice_trials) {
    if (!row.response) continue;
    PlannedTrial planned{.intensity = row.intensity,
                         .reference_intensity = row.reference_intensity,
                         .is_catch = row.is_catch};
    if (row.test_interval) planned.test_interval = static_cast<int>(*row.test_interval);
    answered[{row.session, row.block}].push_back({planned, *row.response});
  }
  for (const auto& [key, trials] : answered) {
    analysis::PracticeRun run{.participant = participant.participant,
                              .block = key.second,
                              .num_trials = static_cast<int>(trials.size())};
    try {
      const Block* const block = blocks.find(key.first, key.second);
      if (block != nullptr && block->practice) {
        const PracticeState state = practice_state(*block, trials);
        run.num_judged = state.num_judged;
        run.num_correct = state.num_correct;
        run.criterion_met = state.criterion_is_met;
      } else {
        run.problem = "its study file has no such practice";
      }
    } catch (const core::Error& error) {
      run.problem = error.what();
    }
    data.practice.push_back(std::move(run));
  }
}

}  // namespace

analysis::StudyData load_study_data(const core::StudyStore& store, bool with_pilots) {
  analysis::StudyData data = analysis::load_study(store, with_pilots);
  StoredBlocks blocks(store);
  for (const ParticipantData& participant : data.participants) {
    add_practice(data, blocks, participant);
  }
  for (const analysis::BlockDesign& design : data.blocks) {
    if (!analysis::is_adaptive(design)) continue;
    for (const ParticipantData& participant : data.participants) {
      for (const auto& [session, trials] : trials_by_session(participant, design.block)) {
        analysis::AdaptiveRun run = run_of(blocks, session, design, trials);
        run.participant = participant.participant;
        run.block = design.block;
        data.runs.push_back(std::move(run));
      }
    }
  }
  return data;
}

}  // namespace jnd::app
