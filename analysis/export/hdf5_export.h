#pragma once

#include <filesystem>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes `folder`/study.h5: a group a session, session_0001, with a column for every channel
/// of its recording, its unit as attribute, in SI and double precision; what the loop's time
/// was spent on in the groups `trials` and `presentations`, whose ticks point into `tick`; and
/// in `gaps` the ticks that were lost: nothing is filled in. A session without recording has
/// the tables alone. Recordings are what the format is for, so `options.recordings` changes
/// nothing. The same study gives the same bytes. `folder` must not exist or be empty; it is
/// there as a whole or not at all. Throws `Error`.
void export_hdf5(const core::StudyStore& store, const std::filesystem::path& folder,
                 const ExportOptions& options);

}  // namespace jnd::analysis
