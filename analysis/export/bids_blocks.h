#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/export/study_tables.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What a participant did in one block: a task, in the words of BIDS.
struct BidsBlock {
  std::string block;  ///< Its name in the study file.
  std::vector<ExportedTrial> trials;
  std::vector<core::PresentationRow> presentations;
  std::int64_t first_tick = 0, last_tick = 0;  ///< From its first trial to the end of its last.
  std::int64_t time_ns = 0;                    ///< Of `first_tick`.
};

/// The blocks of a session that have an answered trial, in the order of their first ticks.
[[nodiscard]] std::vector<BidsBlock> bids_blocks(const core::StudyStore& store,
                                                 const core::SessionRow& session);

/// The front of a file's name, "sub-P01_ses-01_task-estimation", and what it stands for.
struct BidsTask {
  std::string front;
  std::string task_name;  ///< As the sidecars tell it: the block.
  std::string description;
};

/// Events of a block: onset and duration, what was presented, what was answered; and the gaps
/// of its recording as events of their own.
void write_bids_events(const std::filesystem::path& front, const BidsBlock& block,
                       double rate_hz, const std::vector<RecordingGap>& gaps);

/// beh/..._beh.tsv and its sidecar: one row a trial whose answer stands.
void write_bids_beh(const std::filesystem::path& folder, const BidsTask& task,
                    const BidsBlock& block);

}  // namespace jnd::analysis
