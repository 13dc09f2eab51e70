#pragma once

#include <filesystem>
#include <string>

#include "core/storage/study_store.h"

namespace jnd::app {

/// Has the study remember that what it holds is about to be written to `out`, a new or empty
/// folder, so that a withdrawal names it; anything else is refused by who writes, and is not
/// remembered. `kind`: "csv", "bids", "hdf5", "xdf", "report"; `pilot`: pilot sessions, too.
/// Returns
/// "" or, for a study that cannot be written to, the sentence that it does not remember: who
/// reads a study on a read-only disk is not kept from it. Not real time.
[[nodiscard]] std::string noted_export(const core::StudyStore& store,
                                       const std::filesystem::path& out,
                                       const std::string& kind, bool pilot);

}  // namespace jnd::app
