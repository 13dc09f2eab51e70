#include "analysis/export/bids_blocks.h"

#include <algorithm>
#include <map>
#include <set>

#include "analysis/data/json_fields.h"

namespace jnd::analysis {
namespace {

BidsBlock& block_of(std::vector<BidsBlock>& blocks, const ExportedTrial& trial) {
  for (BidsBlock& block : blocks) {
    if (block.name == trial.row.block) return block;
  }
  blocks.push_back({.name = trial.row.block,
                    .first_tick = trial.row.first_tick,
                    .last_tick = trial.row.last_tick});
  return blocks.back();
}

void widen(BidsBlock& block, std::int64_t first_tick, std::int64_t last_tick) {
  block.first_tick = std::min(block.first_tick, first_tick);
  block.last_tick = std::max(block.last_tick, last_tick);
}

std::vector<BidsBlock> blocks_of_trials(const core::StudyStore& store,
                                        const core::SessionRow& session,
                                        const ExportSelection& selection) {
  std::vector<BidsBlock> blocks;
  const std::vector<ExportedTrial> trials = exported_trials(store, session.session, selection);
  for (const ExportedTrial& trial : trials) {
    BidsBlock& block = block_of(blocks, trial);
    widen(block, trial.row.first_tick, trial.row.last_tick);
    block.trials.push_back(trial);
  }
  for (ExportedPresentation& one : exported_presentations(store, session.session, trials)) {
    for (BidsBlock& block : blocks) {
      if (block.name != one.block) continue;
      widen(block, one.row.first_tick, one.row.last_tick);
      block.presentations.push_back(std::move(one));
      break;
    }
  }
  for (ExportedAnswer& one : exported_question_answers(store, session.session, trials)) {
    const auto block = std::ranges::find(blocks, one.row.block, &BidsBlock::name);
    if (block != blocks.end()) block->answers.push_back(std::move(one));
  }
  return blocks;
}

std::string stage_name(const std::vector<std::string>& names, std::int64_t stage) {
  const auto place = static_cast<std::size_t>(stage);
  if (stage >= 0 && place < names.size() && !names[place].empty()) return names[place];
  return "stage" + std::to_string(stage + 1);
}

std::vector<BidsBlock> explored_stages(const std::vector<core::EventRow>& events,
                                       const std::vector<std::string>& stage_names) {
  std::set<std::int64_t> superseded;
  for (const core::EventRow& event : events) {
    if (event.supersedes) superseded.insert(*event.supersedes);
  }
  std::map<std::int64_t, BidsBlock> stages;
  for (const core::EventRow& event : events) {
    if (event.kind != "medium_explored" || superseded.contains(event.sequence)) continue;
    if (!event.first_tick || !event.last_tick || !event.stage) continue;
    const auto [stage, is_new] = stages.try_emplace(*event.stage);
    if (is_new) {
      stage->second.name = stage_name(stage_names, *event.stage);
      stage->second.first_tick = *event.first_tick;
    }
    widen(stage->second, *event.first_tick, *event.last_tick);
    stage->second.explored.push_back({.medium = string_at(object_in(event.data), "medium"),
                                      .intensity = event.intensity,
                                      .first_tick = *event.first_tick,
                                      .last_tick = *event.last_tick});
  }
  std::vector<BidsBlock> all;
  for (auto& [number, stage] : stages) all.push_back(std::move(stage));
  return all;
}

/// The time of a tick: that of the event that begins with it or, without one, computed from the
/// session's start.
std::int64_t time_of(const std::vector<core::EventRow>& events, std::int64_t tick,
                     const core::SessionRow& session) {
  for (const core::EventRow& event : events) {
    if (event.first_tick == tick && !event.last_tick) return event.time_ns;
  }
  const double since_start_ns =
      session.rate_hz > 0.0 ? 1e9 * static_cast<double>(tick) / session.rate_hz : 0.0;
  return session.started_time_ns + static_cast<std::int64_t>(since_start_ns);
}

}  // namespace

std::vector<BidsBlock> bids_blocks(const core::StudyStore& store,
                                   const core::SessionRow& session,
                                   const std::vector<std::string>& stage_names,
                                   const ExportSelection& selection) {
  const std::vector<core::EventRow> events = store.events(session.session);
  std::vector<BidsBlock> blocks = blocks_of_trials(store, session, selection);
  for (BidsBlock& stage : explored_stages(events, stage_names)) {
    if (!selection.blocks.empty()) break;
    const bool taken = std::ranges::any_of(
        blocks, [&](const BidsBlock& block) { return block.name == stage.name; });
    if (taken) stage.name += "_explored";
    blocks.push_back(std::move(stage));
  }
  std::ranges::stable_sort(blocks, {}, &BidsBlock::first_tick);
  for (BidsBlock& block : blocks) block.time_ns = time_of(events, block.first_tick, session);
  return blocks;
}

}  // namespace jnd::analysis
