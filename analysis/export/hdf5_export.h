#pragma once

#include <filesystem>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes `folder`/study.h5: the tables that the CSV has, a group each with a dataset a column,
/// in a group a session, session_0001: `trials`, `presentations`, `events`, `answers`,
/// `questionnaires` and `gaps`, the ticks that were lost, for nothing is filled in; beside them
/// a dataset for every channel of its recording, in SI and double precision, into which the
/// ticks of the tables point. At the top `sessions`, and `codebook` with unit and meaning of
/// every column, which are attributes, too. Recordings are what the format is for, so
/// `options.recordings` changes nothing. Text is ASCII, or UTF-8 where a column needs it. The
/// same study gives the same bytes. `folder` must not exist or be empty; it is there as a whole
/// or not at all. Throws `Error`.
ExportOutcome export_hdf5(const core::StudyStore& store, const std::filesystem::path& folder,
                          const ExportOptions& options);

}  // namespace jnd::analysis
