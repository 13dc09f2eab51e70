#include "analysis/export/bids_dataset.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/export/bids_text.h"
#include "analysis/questionnaire_items.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json parsed(const core::ProtocolRow& protocol) {
  ordered_json json = ordered_json::parse(protocol.text, nullptr, false);
  return json.is_object() ? json : ordered_json::object();
}

/// A text of a study file, in English where it has that.
std::string text_at(const ordered_json& protocol, const char* key) {
  const auto found = protocol.find(key);
  if (found == protocol.end()) return "";
  if (found->is_string()) return found->get<std::string>();
  if (!found->is_object() || found->empty()) return "";
  const auto english = found->find("en");
  const ordered_json& text = english != found->end() ? *english : *found->begin();
  return text.is_string() ? text.get<std::string>() : "";
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

std::string title_of(const BidsDataset& dataset) {
  std::vector<std::string> titles;
  for (const core::ProtocolRow& protocol : dataset.protocols) {
    const ordered_json json = parsed(protocol);
    std::string title = text_at(json, "title");
    if (title.empty()) title = text_at(json, "name");
    if (title.empty()) title = protocol.file_name;
    if (std::ranges::find(titles, title) == titles.end()) titles.push_back(title);
  }
  return (dataset.simulated ? "SIMULATED: " : "") + joined(titles);
}

std::vector<std::string> authors_of(const BidsDataset& dataset) {
  std::vector<std::string> authors;
  for (const core::ProtocolRow& protocol : dataset.protocols) {
    const ordered_json json = parsed(protocol);
    const auto found = json.find("authors");
    if (found == json.end() || !found->is_array()) continue;
    for (const ordered_json& author : *found) {
      if (!author.is_string()) continue;
      const std::string name = author.get<std::string>();
      if (std::ranges::find(authors, name) == authors.end()) authors.push_back(name);
    }
  }
  return authors;
}

ordered_json generated_by(const BidsDataset& dataset) {
  std::vector<std::string> versions;
  for (const core::SessionRow& row : dataset.sessions) {
    if (std::ranges::find(versions, row.program_version) == versions.end()) {
      versions.push_back(row.program_version);
    }
  }
  return ordered_json::array(
      {{{"Name", "jnd"}, {"Version", joined(versions)}, {"Description", "jnd export bids"}}});
}

std::string readme(const BidsDataset& dataset) {
  std::string text = "# " + title_of(dataset) + "\n\n";
  if (dataset.simulated) {
    text +=
        "**The data are SIMULATED**: participants and apparatus are models in a program; "
        "nobody "
        "was asked.\n\n";
  }
  for (const core::ProtocolRow& protocol : dataset.protocols) {
    const std::string about = text_at(parsed(protocol), "description");
    if (!about.empty()) text += about + "\n\n";
  }
  text +=
      "A haptic psychophysics study, recorded by jnd and exported by `jnd export bids`.\n\n"
      "- `sub-*/ses-*/beh`: a task is a block of the study; a row is a trial whose answer "
      "stands. Use those with `excluded` 0.\n";
  text +=
      dataset.motion
          ? "- `sub-*/ses-*/motion`: every sample of the haptic loop in the workspace frame "
            "(x to the participant's right, y away, z up). Forces, those on the hand, are "
            "channels of type MISC in N. A sample that was lost is a row of n/a and an event "
            "`missing_samples`; nothing is filled in.\n"
          : "- No `motion`: the export was made without recordings.\n";
  text +=
      "- `participants.tsv` tells pseudonyms; `phenotype/`: questionnaires.\n"
      "- `sourcedata/`: the study file and the study folder, which `jnd` opens.\n"
      "- `derivatives/jnd/`: what `jnd results --json` says.\n";
  if (dataset.motion) {
    text +=
        "\nThe schema-based validator takes the first row of a motion file for names, and a "
        "hand "
        "at rest repeats its values there: tell it to ignore `TSV_COLUMN_HEADER_DUPLICATE`.\n";
  }
  return text;
}

/// An answer given in the visits of a participant, the last one; "" if there is none.
std::string answer_of(const core::StudyStore& store, const BidsDataset& dataset,
                      const std::string& participant, const QuestionnaireItem& item) {
  std::string answer;
  for (const core::SessionRow& session : dataset.sessions) {
    if (session.participant != participant) continue;
    for (const core::AnswerRow& row : store.answers(session.session)) {
      if (row.stage == item.stage && row.item == item.name) answer = row.answer;
    }
  }
  return answer;
}

std::string described_item(const QuestionnaireItem& item) {
  std::string text = item.question.empty() ? item.name : item.question;
  if (item.num_steps > 0) text += " (scale from 1 to " + std::to_string(item.num_steps) + ")";
  return text;
}

void write_phenotype(const fs::path& folder, const std::string& stage, const std::string& label,
                     const std::vector<QuestionnaireItem>& items, const BidsDataset& dataset,
                     const core::StudyStore& store) {
  std::vector<std::string> names = {"participant_id"};
  ordered_json sidecar = {
      {"MeasurementToolMetadata", {{"Description", "Questions of the stage " + stage}}}};
  for (const QuestionnaireItem& item : items) {
    if (item.stage != stage) continue;
    names.push_back(item.name);
    sidecar[item.name]["Description"] = described_item(item);
    if (!item.unit.empty()) sidecar[item.name]["Units"] = item.unit;
  }
  CsvTableWriter table(folder / (label + ".tsv"), names, TableStyle::kBids);
  for (const auto& [participant, subject] : dataset.subjects) {
    table.cell("sub-" + subject);
    for (const QuestionnaireItem& item : items) {
      if (item.stage == stage) table.cell(answer_of(store, dataset, participant, item));
    }
    table.end_row();
  }
  table.finish();
  write_json(folder / (label + ".json"), sidecar);
}

void write_phenotypes(const fs::path& folder, const std::vector<QuestionnaireItem>& items,
                      const BidsDataset& dataset, const core::StudyStore& store) {
  std::vector<std::string> stages;
  for (const QuestionnaireItem& item : items) stages.push_back(item.stage);
  for (const auto& [stage, label] : bids_labels(stages)) {
    fs::create_directories(folder / "phenotype");
    write_phenotype(folder / "phenotype", stage, label, items, dataset, store);
  }
}

}  // namespace

void write_bids_descriptions(const fs::path& folder, const BidsDataset& dataset,
                             std::int64_t last_time_ns) {
  ordered_json description = {{"Name", title_of(dataset)},
                              {"BIDSVersion", kBidsVersion},
                              {"DatasetType", "raw"},
                              {"Authors", authors_of(dataset)},
                              {"GeneratedBy", generated_by(dataset)},
                              {"Simulated", dataset.simulated}};
  write_json(folder / "dataset_description.json", description);
  write_text(folder / "README.md", readme(dataset));
  write_text(folder / "CHANGES", "1.0.0 " + iso_date(last_time_ns) +
                                     "\n  - Exported by jnd as the study was then.\n");
}

void write_bids_participants(const fs::path& folder, const BidsDataset& dataset,
                             const core::StudyStore& store) {
  std::vector<QuestionnaireItem> items;
  for (const core::ProtocolRow& protocol : dataset.protocols) {
    merge_items(items,
                questionnaire_items(nlohmann::json::parse(protocol.text, nullptr, false)));
  }
  const std::vector<CsvColumn> columns = {
      {"participant_id", "", "Label of the participant in this data set"},
      {"pseudonym", "", "As the study has it"},
      {"data_origin", "", "SIMULATED: a model in a program; person"},
      {"num_sessions", "", "Visits in this data set"}};
  CsvTableWriter table(folder / "participants.tsv", columns, TableStyle::kBids);
  for (const auto& [participant, subject] : dataset.subjects) {
    std::int64_t num_sessions = 0;
    bool simulated = false;
    for (const core::SessionRow& row : dataset.sessions) {
      if (row.participant != participant) continue;
      ++num_sessions;
      simulated |= row.simulated;
    }
    table.cell("sub-" + subject).cell(participant).cell(simulated ? "SIMULATED" : "person");
    table.cell(num_sessions).end_row();
  }
  table.finish();
  write_json(folder / "participants.json", described(columns));
  write_phenotypes(folder, items, dataset, store);
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
