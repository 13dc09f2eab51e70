#pragma once

#include <filesystem>
#include <string>

#include "core/storage/study_store.h"

namespace jnd::app {

/// Makes the study remember that its contents are about to be written to `out`, so that a
/// withdrawal names that place. If `out` is neither new nor empty, nothing is remembered,
/// because the writer refuses it. `kind` is "csv", "bids", "hdf5", "xdf", "figures" or
/// "report"; `pilot` tells that pilot sessions are included. Returns "", or, if nothing can be
/// written to the study, a sentence that it does not remember: a study on a read-only disk can
/// still be exported. Not real time.
[[nodiscard]] std::string noted_export(const core::StudyStore& store,
                                       const std::filesystem::path& out,
                                       const std::string& kind, bool pilot);

}  // namespace jnd::app
