#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/export/factor_columns.h"
#include "analysis/export/table_rows.h"
#include "core/storage/recorded_ticks.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// A medium that was felt outside of trials.
struct BidsExploration {
  std::string medium;
  std::optional<double> intensity;
  std::int64_t first_tick = 0, last_tick = 0;
};

/// What a participant did in one block, or in one stage that shows media outside of trials.
/// BIDS calls it a task.
struct BidsBlock {
  std::string name;                   ///< The name of the block or stage in the study file.
  std::vector<ExportedTrial> trials;  ///< Empty for a stage that only shows media.
  std::vector<ExportedPresentation> presentations;
  std::vector<ExportedAnswer> answers;    ///< The answers to questions after the trials.
  std::vector<BidsExploration> explored;  ///< The explored media; empty for a block.
  std::int64_t first_tick = 0,
               last_tick = 0;  ///< From the first medium to the end of the last.
  std::int64_t time_ns = 0;    ///< The time of `first_tick`.
};

/// The blocks of a session with an answered trial, and the stages in which media were explored,
/// in the order of their first ticks. A stage without a known name is "stageN", counted from 1.
/// A stage with the name of a block is "NAME_explored". If blocks are chosen, only these are
/// returned.
[[nodiscard]] std::vector<BidsBlock> bids_blocks(const core::StudyStore& store,
                                                 const core::SessionRow& session,
                                                 const std::vector<std::string>& stage_names,
                                                 const ExportSelection& selection);

/// The front of a file's name, such as "sub-P01_ses-01_task-estimation", and what it stands
/// for.
struct BidsTask {
  std::string front;
  std::string task_name;  ///< The name in the sidecars, which is that of the block.
  std::string description;
};

/// Writes the events of a block: onset and duration, what was presented or explored, and what
/// was answered. The gaps of its recording are separate events.
void write_bids_events(const std::filesystem::path& front, const BidsBlock& block,
                       const core::SessionRow& session,
                       const std::vector<core::TickRange>& gaps);

/// Writes beh/..._beh.tsv and its sidecar. It has one row for each trial with a valid answer,
/// and a column question_NAME for each question that follows trials. `factors` adds its columns
/// to those of `trial_columns`.
void write_bids_beh(const std::filesystem::path& folder, const BidsTask& task,
                    const BidsBlock& block, const core::SessionRow& session,
                    FactorColumns& factors);

}  // namespace jnd::analysis
