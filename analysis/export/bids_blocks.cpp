#include "analysis/export/bids_blocks.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/export/bids_text.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

const std::vector<CsvColumn>& bids_event_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"onset", "s", "From the first sample of the block"},
      {"duration", "s", "Until the stimulus ended or samples came again"},
      {"trial_type", "",
       "test, reference or free_space: what was presented; missing_samples: a gap in the "
       "recording, in "
       "which nothing is filled in"},
      {"trial", "", "Running number in the session, from 1"},
      {"attempt", "", "1, or more if the trial was repeated"},
      {"presentation", "", "Within the attempt, from 1"},
      {"intensity", "unit of quantity", "What was presented; its quantity is told in beh"},
      {"response", "", "Of the trial: percent; 1 yes, 0 no; in production the value set"},
      {"response_time", "s", "Of the trial: from the start of its last stimulus to the answer"},
      {"sample", "", "Row of the first sample in the motion file, from 0"},
  };
  return kColumns;
}

struct BidsEvent {
  std::int64_t first_tick = 0, last_tick = 0;
  const core::PresentationRow* presentation = nullptr;  ///< None: samples are missing.
};

const ExportedTrial* trial_of(const BidsBlock& block, std::int64_t trial) {
  const auto found = std::ranges::find_if(
      block.trials, [trial](const ExportedTrial& one) { return one.row.trial == trial; });
  return found == block.trials.end() ? nullptr : &*found;
}

BidsBlock& block_of(std::vector<BidsBlock>& blocks, const ExportedTrial& trial) {
  for (BidsBlock& block : blocks) {
    if (block.block == trial.row.block) return block;
  }
  blocks.push_back({.block = trial.row.block,
                    .first_tick = trial.row.first_tick,
                    .last_tick = trial.row.last_tick});
  return blocks.back();
}

/// When a tick was: by the event that begins with it, or else by the session's start.
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
                                   const core::SessionRow& session) {
  std::vector<BidsBlock> blocks;
  for (ExportedTrial& trial : exported_trials(store, session.session)) {
    BidsBlock& block = block_of(blocks, trial);
    block.first_tick = std::min(block.first_tick, trial.row.first_tick);
    block.last_tick = std::max(block.last_tick, trial.row.last_tick);
    block.trials.push_back(std::move(trial));
  }
  for (const core::PresentationRow& row : store.presentations(session.session)) {
    for (BidsBlock& block : blocks) {
      if (trial_of(block, row.trial) == nullptr) continue;
      block.first_tick = std::min(block.first_tick, row.first_tick);
      block.last_tick = std::max(block.last_tick, row.last_tick);
      block.presentations.push_back(row);
    }
  }
  std::ranges::stable_sort(blocks, {}, &BidsBlock::first_tick);
  const std::vector<core::EventRow> events = store.events(session.session);
  for (BidsBlock& block : blocks) block.time_ns = time_of(events, block.first_tick, session);
  return blocks;
}

void write_bids_events(const fs::path& front, const BidsBlock& block, double rate_hz,
                       const std::vector<RecordingGap>& gaps) {
  std::vector<BidsEvent> events;
  for (const core::PresentationRow& row : block.presentations) {
    events.push_back({row.first_tick, row.last_tick, &row});
  }
  for (const RecordingGap& gap : gaps) events.push_back({gap.first_tick, gap.last_tick});
  std::ranges::stable_sort(events, {}, &BidsEvent::first_tick);
  CsvTableWriter table(front.string() + "_events.tsv", bids_event_columns(), TableStyle::kBids);
  for (const BidsEvent& event : events) {
    const std::int64_t sample = event.first_tick - block.first_tick;
    table.cell(static_cast<double>(sample) / rate_hz);
    table.cell(static_cast<double>(event.last_tick - event.first_tick + 1) / rate_hz);
    if (event.presentation == nullptr) {
      table.cell("missing_samples").nothing().nothing().nothing();
      table.nothing().nothing().nothing();
    } else {
      const core::PresentationRow& row = *event.presentation;
      const core::TrialRow& trial = trial_of(block, row.trial)->row;
      table.cell(row.interval).cell(row.trial).cell(row.attempt).cell(row.presentation);
      table.cell(row.intensity).cell(trial.response).cell(trial.response_time_s);
    }
    table.cell(sample).end_row();
  }
  table.finish();
  write_json(front.string() + "_events.json", described(bids_event_columns()));
}

void write_bids_beh(const fs::path& folder, const BidsTask& task, const BidsBlock& block) {
  const std::vector<CsvColumn>& all = trial_columns();
  const std::vector<CsvColumn> columns(all.begin() + kNumTrialOwners, all.end());
  CsvTableWriter table(folder / (task.front + "_beh.tsv"), columns, TableStyle::kBids);
  for (const ExportedTrial& trial : block.trials) {
    write_trial(table, trial);
    table.end_row();
  }
  table.finish();
  nlohmann::ordered_json sidecar = {{"TaskName", task.task_name},
                                    {"TaskDescription", task.description}};
  sidecar.update(described(columns));
  write_json(folder / (task.front + "_beh.json"), sidecar);
}

}  // namespace jnd::analysis
