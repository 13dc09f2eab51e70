#pragma once

#include <filesystem>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes `folder`/session_0001.xdf and so on, one file for every session. It has the session's
/// markers, its samples (the channels of `options.selection`, or the hand's position, velocity
/// and force), and every stream of another recorder, unchanged, with the comparisons of its
/// clock with ours. Times are those of the machine's monotonic clock; see `SessionClock`.
/// `folder` must not exist or must be empty. It is written as a whole or not at all. Throws
/// `Error`.
ExportOutcome export_xdf(const core::StudyStore& store, const std::filesystem::path& folder,
                         const ExportOptions& options);

}  // namespace jnd::analysis
