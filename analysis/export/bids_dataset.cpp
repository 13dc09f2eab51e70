#include "analysis/export/bids_dataset.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/data/stored_studies.h"
#include "analysis/export/bids_text.h"
#include "analysis/export/csv_table_writer.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

/// A text in English, or in the first language of the study.
std::string in_words_of(const experiments::Study& study, const experiments::Text& text) {
  if (text.contains("en") || study.languages.empty()) return in_english(text);
  const auto first = text.find(study.languages.front());
  return first == text.end() ? in_english(text) : first->second;
}

std::string title_of(const BidsDataset& dataset) {
  std::vector<std::string> titles;
  for (std::size_t i = 0; i < dataset.studies.size(); ++i) {
    const experiments::Study& study = dataset.studies[i];
    std::string title = in_words_of(study, study.title);
    if (title.empty()) title = study.name;
    if (title.empty()) title = dataset.protocols[i].file_name;
    if (std::ranges::find(titles, title) == titles.end()) titles.push_back(title);
  }
  return (dataset.simulated ? "SIMULATED: " : "") + joined(titles);
}

std::vector<std::string> authors_of(const BidsDataset& dataset) {
  std::vector<std::string> authors;
  for (const experiments::Study& study : dataset.studies) {
    for (const std::string& name : study.authors) {
      if (std::ranges::find(authors, name) == authors.end()) authors.push_back(name);
    }
  }
  return authors;
}

ordered_json generated_by(const BidsDataset& dataset) {
  ordered_json by = {{"Name", "jnd"}, {"Description", "jnd export bids"}};
  if (!dataset.program_version.empty()) by["Version"] = dataset.program_version;
  return ordered_json::array({by});
}

constexpr char kMotionText[] =
    "- `sub-*/ses-*/motion`: the samples of the haptic loop from the first medium of a task to "
    "the end of its last, in the workspace frame (x to the participant's right, y away, z up). "
    "Those between tasks, in breaks and instructions, are in `sourcedata/` alone. Forces, "
    "those "
    "on the hand, are channels of type MISC in N. A sample that was lost is a row of n/a and "
    "an "
    "event `missing_samples`; nothing is filled in.\n";

constexpr char kValidatorText[] =
    "\nThe schema-based validator takes the first row of a motion file for names, and a hand "
    "at "
    "rest repeats its values there: tell it to ignore `TSV_COLUMN_HEADER_DUPLICATE`. The older "
    "one reads whole files into memory: with motion of many gigabytes give it more "
    "(`NODE_OPTIONS=--max-old-space-size=16384`), or validate a few subjects at a time.\n";

std::string motion_text(const BidsDataset& dataset) {
  if (dataset.motion) return kMotionText;
  return std::string("- No `motion`: ") + (dataset.recordings
                                               ? "the study has no samples of its tasks.\n"
                                               : "the export was made without recordings.\n");
}

/// Describes the written files and where they are.
std::string contents(const fs::path& folder, const BidsDataset& dataset) {
  std::string text;
  if (dataset.trials) {
    text +=
        "- `sub-*/ses-*/beh`: a task is a block of the study. A row is a trial whose answer "
        "stands. Use those with `excluded` 0.\n";
  }
  if (dataset.explored) {
    text +=
        "- A stage in which media were explored outside of trials is a task, too, with events "
        "alone.\n";
  }
  text += motion_text(dataset) +
          "- `participants.tsv` tells pseudonyms, `sub-*/sub-*_sessions.tsv` the visits.\n";
  if (fs::exists(folder / "phenotype")) text += "- `phenotype/`: questionnaires.\n";
  text += std::string("- Tables: ") + kTextsOfTables + ".\n";
  text +=
      "- `sourcedata/`: the study file and the study folder, which `jnd` opens, with the log "
      "of "
      "every event.\n";
  if (fs::exists(folder / "sourcedata" / "device_profiles")) {
    text +=
        "- `sourcedata/device_profiles/`: what was measured of the device before a session, by "
        "its `device_profile_sha256` in the study.\n";
  }
  if (fs::exists(folder / "sourcedata" / "laboratories")) {
    text +=
        "- `sourcedata/laboratories/`: who was simulated, by the `laboratory_sha256` of a "
        "visit.\n";
  }
  if (fs::exists(folder / "derivatives")) {
    text += "- `derivatives/jnd/`: what `jnd results --json` says.\n";
  }
  return text;
}

std::string readme(const fs::path& folder, const BidsDataset& dataset) {
  std::string text = "# " + title_of(dataset) + "\n\n";
  if (dataset.simulated) {
    text +=
        "**The data are SIMULATED**: participants and apparatus are models in a program; "
        "nobody "
        "was asked.\n\n";
  }
  for (const experiments::Study& study : dataset.studies) {
    const std::string about = in_words_of(study, study.description);
    if (!about.empty()) text += about + "\n\n";
  }
  text +=
      "A haptic psychophysics study, recorded by jnd and exported by `jnd export bids`.\n\n" +
      contents(folder, dataset);
  if (!dataset.problems.empty()) text += "\n## What the recordings have lost\n\n";
  for (const std::string& problem : dataset.problems) text += "- " + problem + "\n";
  if (dataset.motion) text += kValidatorText;
  return text;
}

}  // namespace

void write_bids_descriptions(const fs::path& folder, const BidsDataset& dataset,
                             std::optional<std::int64_t> last_time_ns) {
  ordered_json description = {{"Name", title_of(dataset)},
                              {"BIDSVersion", kBidsVersion},
                              {"DatasetType", "raw"},
                              {"Authors", authors_of(dataset)},
                              {"GeneratedBy", generated_by(dataset)},
                              {"Simulated", dataset.simulated}};
  write_json(folder / "dataset_description.json", description);
  write_text(folder / "README.md", readme(folder, dataset));
  const std::string date = last_time_ns ? " " + iso_date(*last_time_ns) : "";
  write_text(folder / "CHANGES",
             "1.0.0" + date + "\n  - Exported by jnd as the study was then.\n");
}

void write_bids_derivatives(const fs::path& folder, const BidsDataset& dataset,
                            const std::string& results_json) {
  if (results_json.empty()) return;
  const fs::path derivatives = folder / "derivatives" / "jnd";
  fs::create_directories(derivatives);
  write_json(derivatives / "dataset_description.json",
             {{"Name", "Fits and comparisons: " + title_of(dataset)},
              {"BIDSVersion", kBidsVersion},
              {"DatasetType", "derivative"},
              {"GeneratedBy", generated_by(dataset)},
              {"Simulated", dataset.simulated}});
  write_text(derivatives / "results.json", results_json + "\n");
}

}  // namespace jnd::analysis
