#include "analysis/data/practice_runs.h"

#include <map>
#include <utility>

#include "analysis/data/planned_trials.h"
#include "core/error.h"
#include "experiments/procedures/practice.h"

namespace jnd::analysis {
namespace {

using experiments::AnsweredTrial;
using experiments::Block;

/// The answered practice trials of each session and block, in the order of the answers.
std::map<std::pair<std::int64_t, std::string>, std::vector<AnsweredTrial>> answered_of(
    const ParticipantData& participant) {
  std::map<std::pair<std::int64_t, std::string>, std::vector<AnsweredTrial>> answered;
  for (const core::TrialRow& row : participant.practice_trials) {
    answered[{row.session, row.block}].push_back({planned_trial(row), row.response});
  }
  return answered;
}

}  // namespace

void add_practice_runs(StudyData& data, const core::StudyStore& store, StoredStudies& studies) {
  std::map<std::int64_t, std::string> hashes;
  for (const core::SessionRow& row : store.sessions()) {
    hashes[row.session] = row.protocol_sha256;
  }
  for (const ParticipantData& participant : data.participants) {
    for (const auto& [key, trials] : answered_of(participant)) {
      PracticeRun run{.participant = participant.participant,
                      .block = key.second,
                      .num_trials = static_cast<int>(trials.size())};
      try {
        const Block& block = studies.block(hashes[key.first], key.second);
        const experiments::PracticeState state = practice_state(block, trials);
        run.num_judged = state.num_judged;
        run.num_correct = state.num_correct;
        run.criterion_met = state.criterion_is_met;
      } catch (const core::Error& error) {
        run.problem = error.what();
      }
      data.practice.push_back(std::move(run));
    }
  }
}

}  // namespace jnd::analysis
