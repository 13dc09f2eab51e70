#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/export/bids_blocks.h"
#include "analysis/export/exported_recording.h"

namespace jnd::analysis {

/// Writes the recording of a block into `folder`: ..._tracksys-haptic_motion.tsv (no header, a
/// row a tick, or as many as the selection asks for; where no tick of a row is recorded it is a
/// row of n/a, nothing is filled in) and .json, ..._channels.tsv and .json, ..._events.tsv and
/// .json. Returns the name of the motion file;
/// "" and no file if the recording holds none of the block's samples. Throws `Error`.
[[nodiscard]] std::string write_bids_motion(const std::filesystem::path& folder,
                                            const BidsTask& task, const BidsBlock& block,
                                            const core::SessionRow& session,
                                            const ExportedRecording& recording,
                                            const ExportSelection& selection);

}  // namespace jnd::analysis
