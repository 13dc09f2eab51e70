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

/// What all files at the top of a data set are made of.
struct BidsDataset {
  std::vector<core::SessionRow> sessions;
  std::map<std::string, std::string> subjects;  ///< Label of every pseudonym, without "sub-".
  std::vector<core::ProtocolRow> protocols;     ///< Study files of the sessions, each once.
  std::vector<experiments::Study> studies;      ///< What they say, in the same order.
  bool simulated = false;
  bool trials = false;                ///< There is a task of trials,
  bool explored = false;              ///< one of explored media.
  bool motion = false;                ///< There is a motion file.
  bool recordings = false;            ///< They were asked for.
  std::vector<std::string> problems;  ///< What the recordings have lost, a sentence each.
  std::string program_version;        ///< Of the program that exports; "": it is not said.
};

/// dataset_description.json, README.md, which tells what else is in `folder`, and CHANGES.
/// `last_time_ns`: when the last of it happened; none if all of it is simulated.
void write_bids_descriptions(const std::filesystem::path& folder, const BidsDataset& dataset,
                             std::optional<std::int64_t> last_time_ns);
/// sub-LABEL_sessions.tsv and .json in the folder of a subject: what the study knows of each
/// visit. `sessions`: with their labels, "ses-01".
void write_bids_sessions(const std::filesystem::path& folder, const std::string& subject,
                         const std::vector<std::pair<std::string, core::SessionRow>>& sessions,
                         const core::StudyStore& store);
/// participants.tsv and .json, and phenotype/STAGE.tsv and .json for every questionnaire.
void write_bids_participants(const std::filesystem::path& folder, const BidsDataset& dataset,
                             const core::StudyStore& store);
/// derivatives/jnd: what `jnd results --json` says.
void write_bids_derivatives(const std::filesystem::path& folder, const BidsDataset& dataset,
                            const std::string& results_json);

}  // namespace jnd::analysis
