#pragma once

#include <filesystem>
#include <string>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes a study as a BIDS 1.9.0 data set: for every participant and session and each of its
/// tasks, which are its blocks and the stages in which media are explored, `beh` (a row a
/// trial) and events, and on request `motion` (the samples of the task, with channels and
/// events); scans, sessions, participants, phenotype (the questionnaires), sidecars that tell
/// every column; dataset_description.json, README.md, CHANGES. Under sourcedata/ the study file
/// and the study's database, with recordings on request; under derivatives/jnd/ the fits,
/// `results_json` as it is, unless that is "". SIMULATED is said in title, README and
/// participants.
///
/// A pseudonym becomes a label without what BIDS forbids; participants.tsv has both. The same
/// study gives the same bytes. `folder` must not exist or be empty; it is there as a whole or
/// not at all. Throws `Error`, also for a study without a session to export.
ExportOutcome export_bids(const core::StudyStore& store, const std::filesystem::path& folder,
                          const ExportOptions& options, const std::string& results_json);

}  // namespace jnd::analysis
