#include "analysis/export/export_options.h"

#include <algorithm>
#include <set>

#include "analysis/export/exported_recording.h"
#include "analysis/export/recording_rows.h"
#include "core/error.h"

namespace jnd::analysis {

namespace {

void check_blocks(const core::StudyStore& store, const std::vector<core::SessionRow>& sessions,
                  const std::vector<std::string>& chosen) {
  std::set<std::string> blocks;
  for (const core::SessionRow& session : sessions) {
    for (const core::TrialRow& trial : store.trials(session.session, true)) {
      blocks.insert(trial.block);
    }
  }
  for (const std::string& block : chosen) {
    if (blocks.contains(block)) continue;
    std::string all;
    for (const std::string& one : blocks) all += (all.empty() ? "" : ", ") + one;
    throw core::Error("--block: expected a block with an answered trial, which are " +
                      (all.empty() ? "none" : all) + ", found `" + block + "`");
  }
}

}  // namespace

std::vector<core::SessionRow> exported_sessions(const core::StudyStore& store,
                                                const ExportOptions& options) {
  const std::vector<std::string>& chosen = options.selection.participants;
  std::vector<core::SessionRow> sessions;
  for (core::SessionRow& row : store.sessions()) {
    if (row.pilot && !options.pilot) continue;
    if (!chosen.empty() && std::ranges::find(chosen, row.participant) == chosen.end()) continue;
    sessions.push_back(std::move(row));
  }
  for (const std::string& participant : chosen) {
    if (std::ranges::find(sessions, participant, &core::SessionRow::participant) ==
        sessions.end()) {
      throw core::Error("--participant: expected somebody who has a session in " +
                        store.folder().string() + ", found `" + participant +
                        "`, who has none" + (options.pilot ? "" : " but perhaps a pilot's"));
    }
  }
  if (!options.selection.blocks.empty()) {
    check_blocks(store, sessions, options.selection.blocks);
  }
  return sessions;
}

ExpectedSize expected_size(const core::StudyStore& store, const ExportOptions& options,
                           bool is_text) {
  // The average size of a value in sessions of the shipped studies, in which simulated hands
  // mostly move along one axis. Persons' values take more.
  constexpr double kBytesAsText = 7.5, kBytesAsSteps = 0.5;
  ExpectedSize size;
  for (const core::SessionRow& session : exported_sessions(store, options)) {
    const ExportedRecording recording(store, session, options);
    if (!recording.any()) continue;
    const RecordingRows rows(recording, session, options.selection);
    const std::int64_t num_rows =
        core::num_ticks(recording.ticks()) / std::max<std::int64_t>(rows.ticks_per_row(), 1);
    ++size.num_sessions;
    size.num_rows += num_rows;
    size.bytes += (is_text ? kBytesAsText : kBytesAsSteps) * static_cast<double>(num_rows) *
                  static_cast<double>(rows.columns().size());
  }
  return size;
}

bool is_exported(const ExportSelection& selection, const std::string& block) {
  return selection.blocks.empty() ||
         std::ranges::find(selection.blocks, block) != selection.blocks.end();
}

}  // namespace jnd::analysis
