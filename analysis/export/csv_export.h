#pragma once

#include <filesystem>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes a study as tables: sessions.csv, session_values.csv, participants.csv, trials.csv
/// (one row for each trial), presentations.csv, events.csv, markers.csv, answers.csv (all
/// answers outside of trials), questionnaires.csv (the questions, and how each was asked),
/// questions.csv (the answers after trials), deviations.csv if the study was registered, and
/// codebook.csv with the meaning and unit of every column. On request it writes
/// recordings/SESSION.csv, with every sample to the step in which it was stored, and
/// recordings/gaps.csv, with the ticks that are missing. Files have UTF-8, LF, "." decimals,
/// and the shortest digits that read back as the same number. Rows are sorted by session, so
/// the same study gives the same bytes. `folder` must not exist or must be empty. It is written
/// as a whole or not at all. Throws `Error`.
ExportOutcome export_csv(const core::StudyStore& store, const std::filesystem::path& folder,
                         const ExportOptions& options);

}  // namespace jnd::analysis
