#pragma once

#include <filesystem>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes a study as tables: sessions.csv, participants.csv, trials.csv (one row a trial),
/// presentations.csv, events.csv, answers.csv (everything that was answered outside of trials),
/// questionnaires.csv (the questions, with how each was asked), and codebook.csv with the
/// meaning and unit of every column; on request recordings/SESSION.csv, every sample to the
/// step it was stored in, and recordings/gaps.csv, the ticks that are missing in them. UTF-8,
/// LF, "." decimals, the shortest digits that read back as the same number; rows by session, so
/// the same study gives the same bytes. `folder` must not exist or be empty; it is there as a
/// whole or not at all. Throws `Error`.
ExportOutcome export_csv(const core::StudyStore& store, const std::filesystem::path& folder,
                         const ExportOptions& options);

}  // namespace jnd::analysis
