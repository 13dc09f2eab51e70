#pragma once

#include <filesystem>

#include "core/storage/study_store.h"

namespace jnd::analysis {

struct CsvExportOptions {
  bool recordings = false;  ///< Also every sample, one file a session.
  bool pilot = false;       ///< Also pilot sessions.
};

/// Writes a study as tables: sessions.csv, trials.csv (one row a trial), presentations.csv,
/// events.csv, answers.csv, and codebook.csv with the meaning and unit of every column. UTF-8,
/// LF, "." decimals, the shortest digits that read back as the same number; rows by session,
/// so the same study gives the same bytes. `folder` must not exist or be empty. Throws `Error`.
void export_csv(const core::StudyStore& store, const std::filesystem::path& folder,
                const CsvExportOptions& options);

}  // namespace jnd::analysis
