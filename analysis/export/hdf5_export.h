#pragma once

#include <filesystem>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes `folder`/study.h5. Each session has a group, such as session_0001, with the tables
/// `trials`, `presentations`, `events`, `markers`, `answers`, `questionnaires`, `questions` and
/// `gaps`. A table is a group with a dataset for each column, as in the CSV export. `gaps`
/// holds the ticks that were lost, because nothing is filled in. The session's group also has
/// the channels of its recording in SI units, of which most are arrays of steps with a
/// `scale_factor`; the ticks of the tables refer to them. At the top are `sessions`,
/// `session_values`, `deviations` if the study was registered, and `codebook`, which has the
/// unit and meaning of every column; these are also attributes. The format is meant for
/// recordings, so `options.recordings` is ignored. Text is ASCII, or UTF-8 if a column needs
/// it. The same study gives the same bytes. `folder` must not exist or must be empty. It is
/// written as a whole or not at all. Throws `Error`.
ExportOutcome export_hdf5(const core::StudyStore& store, const std::filesystem::path& folder,
                          const ExportOptions& options);

}  // namespace jnd::analysis
