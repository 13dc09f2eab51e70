#pragma once

#include <filesystem>
#include <string>

#include "analysis/export/export_options.h"

namespace jnd::analysis {

/// Writes a study as a BIDS 1.9.0 data set. For every participant and session it has their
/// tasks, which are blocks and stages with explored media. Each task has `beh` (one row for
/// each trial) and events and, on request, `motion` (the samples of the task, with channels and
/// events). It has scans, sessions, participants, phenotype (the questionnaires), sidecars that
/// describe every column, dataset_description.json, README.md and CHANGES. sourcedata/ holds
/// the study file and the study's database, with recordings on request. derivatives/jnd/ holds
/// the fits, `results_json` unchanged, unless it is "". Title, README and participants say
/// SIMULATED if that is so.
///
/// A pseudonym becomes a label without characters that BIDS forbids; participants.tsv has both.
/// The same study gives the same bytes. `folder` must not exist or must be empty. It is written
/// as a whole or not at all. Throws `Error`, also for a study without a session to export.
ExportOutcome export_bids(const core::StudyStore& store, const std::filesystem::path& folder,
                          const ExportOptions& options, const std::string& results_json);

}  // namespace jnd::analysis
