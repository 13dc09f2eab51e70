#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/export/bids_blocks.h"
#include "analysis/export/exported_recording.h"

namespace jnd::analysis {

/// Writes the recording of a block into `folder`: ..._tracksys-haptic_motion.tsv and .json,
/// ..._channels.tsv and .json, ..._events.tsv and .json. The motion file has no header. It has
/// one row for each tick, or as many as the selection asks for. If no tick of a row is
/// recorded, the row is n/a, because nothing is filled in. Returns the name of the motion file,
/// or "" without a file if the recording has none of the block's samples. Throws `Error`.
[[nodiscard]] std::string write_bids_motion(const std::filesystem::path& folder,
                                            const BidsTask& task, const BidsBlock& block,
                                            const core::SessionRow& session,
                                            const ExportedRecording& recording,
                                            const ExportSelection& selection);

}  // namespace jnd::analysis
