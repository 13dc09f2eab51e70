#pragma once

#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What goes into a data set besides what always does.
struct ExportOptions {
  bool recordings = false;  ///< Also every sample.
  bool pilot = false;       ///< Also pilot sessions.
};

/// The sessions of the data set, by number. Who withdrew has none.
[[nodiscard]] std::vector<core::SessionRow> exported_sessions(const core::StudyStore& store,
                                                              const ExportOptions& options);

}  // namespace jnd::analysis
