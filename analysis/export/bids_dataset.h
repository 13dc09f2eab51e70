#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What all files at the top of a data set are made of.
struct BidsDataset {
  std::vector<core::SessionRow> sessions;
  std::map<std::string, std::string> subjects;  ///< Label of every pseudonym, without "sub-".
  std::vector<core::ProtocolRow> protocols;     ///< Of the sessions, each once.
  bool simulated = false;
  bool motion = false;
};

/// dataset_description.json, README.md, CHANGES. `last_time_ns`: when the last of it happened.
void write_bids_descriptions(const std::filesystem::path& folder, const BidsDataset& dataset,
                             std::int64_t last_time_ns);
/// participants.tsv and .json, and phenotype/STAGE.tsv and .json for every questionnaire.
void write_bids_participants(const std::filesystem::path& folder, const BidsDataset& dataset,
                             const core::StudyStore& store);
/// derivatives/jnd: what `jnd results --json` says.
void write_bids_derivatives(const std::filesystem::path& folder, const BidsDataset& dataset,
                            const std::string& results_json);

}  // namespace jnd::analysis
