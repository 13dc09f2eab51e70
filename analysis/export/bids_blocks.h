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

/// What a participant did in one block, or in one stage that shows media outside of trials: a
/// task, in the words of BIDS.
struct BidsBlock {
  std::string name;                   ///< Of the block or stage in the study file.
  std::vector<ExportedTrial> trials;  ///< None in a stage that only shows media.
  std::vector<ExportedPresentation> presentations;
  std::vector<ExportedAnswer> answers;    ///< To questions after the trials.
  std::vector<BidsExploration> explored;  ///< Explored media; a block has none.
  std::int64_t first_tick = 0,
               last_tick = 0;  ///< From its first medium to the end of its last.
  std::int64_t time_ns = 0;    ///< The time of `first_tick`.
};

/// The blocks of a session that have an answered trial and the stages in which media were
/// explored, in the order of their first ticks. A stage whose name is not known is "stageN",
/// counted from 1; one that is named as a block is "NAME_explored". Where blocks are chosen,
/// those alone.
[[nodiscard]] std::vector<BidsBlock> bids_blocks(const core::StudyStore& store,
                                                 const core::SessionRow& session,
                                                 const std::vector<std::string>& stage_names,
                                                 const ExportSelection& selection);

/// The front of a file's name, "sub-P01_ses-01_task-estimation", and what it stands for.
struct BidsTask {
  std::string front;
  std::string task_name;  ///< As the sidecars tell it: the block.
  std::string description;
};

/// Events of a block: onset and duration, what was presented or explored, what was answered;
/// and the gaps of its recording as events of their own.
void write_bids_events(const std::filesystem::path& front, const BidsBlock& block,
                       const core::SessionRow& session,
                       const std::vector<core::TickRange>& gaps);

/// beh/..._beh.tsv and its sidecar: one row a trial whose answer stands, with a column
/// question_NAME for each question that follows trials. `factors`: beside `trial_columns`.
void write_bids_beh(const std::filesystem::path& folder, const BidsTask& task,
                    const BidsBlock& block, const core::SessionRow& session,
                    FactorColumns& factors);

}  // namespace jnd::analysis
