#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::analysis {

/// What the files at the top of a data set are made of.
struct BidsDataset {
  std::vector<core::SessionRow> sessions;
  /// The label of every pseudonym, without "sub-".
  std::map<std::string, std::string> subjects;
  std::vector<core::ProtocolRow> protocols;  ///< The study files of the sessions, each once.
  /// The contents of these files, in the same order.
  std::vector<experiments::Study> studies;
  bool simulated = false;
  bool trials = false;                ///< Whether there is a task with trials.
  bool explored = false;              ///< Whether there is a task with explored media.
  bool motion = false;                ///< Whether there is a motion file.
  bool recordings = false;            ///< Whether recordings were asked for.
  std::vector<std::string> problems;  ///< What the recordings have lost, one sentence each.
  /// The version of the exporting program; if it is "", the data set does not state it.
  std::string program_version;
};

/// Writes dataset_description.json, README.md (which describes the rest of `folder`) and
/// CHANGES. `last_time_ns` is the time of the last event; it is absent if everything is
/// simulated.
void write_bids_descriptions(const std::filesystem::path& folder, const BidsDataset& dataset,
                             std::optional<std::int64_t> last_time_ns);
/// Writes sub-LABEL_sessions.tsv and .json in the folder of a subject, with what the study
/// knows about each visit. `sessions` holds their labels too, such as "ses-01".
void write_bids_sessions(const std::filesystem::path& folder, const std::string& subject,
                         const std::vector<std::pair<std::string, core::SessionRow>>& sessions,
                         const core::StudyStore& store);
/// Writes participants.tsv and .json, and phenotype/STAGE.tsv and .json for every
/// questionnaire.
void write_bids_participants(const std::filesystem::path& folder, const BidsDataset& dataset,
                             const core::StudyStore& store);
/// Writes derivatives/jnd, the output of `jnd results --json`.
void write_bids_derivatives(const std::filesystem::path& folder, const BidsDataset& dataset,
                            const std::string& results_json);

}  // namespace jnd::analysis
