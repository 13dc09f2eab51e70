#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/data/questionnaire_items.h"
#include "analysis/export/bids_dataset.h"
#include "analysis/export/bids_text.h"
#include "analysis/export/csv_table_writer.h"
#include "analysis/export/study_tables.h"
#include "analysis/export/table_rows.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr char kSimulatedMeaning[] = "1: SIMULATED participant and apparatus";

bool is_simulated(const BidsDataset& dataset, const std::string& participant) {
  return std::ranges::any_of(dataset.sessions, [&](const core::SessionRow& row) {
    return row.participant == participant && row.simulated;
  });
}

/// The last answer that a participant gave in any visit; "" if there is none.
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

/// The sidecar of an item. `description` describes it. Coded values have their words.
ordered_json sidecar_of(const QuestionnaireItem& item, const std::string& description) {
  ordered_json about = {{"Description", description}};
  if (!item.unit.empty()) about["Units"] = item.unit;
  ordered_json levels = ordered_json::object();
  for (std::size_t i = 0; i < item.options.size(); ++i) {
    const std::string& label = item.option_labels.at(i);
    levels[item.options[i]] = label.empty() ? item.options[i] : label;
  }
  if (item.num_steps > 0 && !item.low_label.empty()) levels["1"] = item.low_label;
  if (item.num_steps > 0 && !item.high_label.empty()) {
    levels[std::to_string(item.num_steps)] = item.high_label;
  }
  if (!levels.empty()) about["Levels"] = std::move(levels);
  return about;
}

void write_phenotype(const fs::path& folder, const std::string& stage, const std::string& label,
                     const std::vector<QuestionnaireItem>& items, const BidsDataset& dataset,
                     const core::StudyStore& store) {
  std::vector<std::string> names = {"participant_id", "simulated"};
  ordered_json sidecar = {
      {"MeasurementToolMetadata", {{"Description", "Questions of the stage " + stage}}},
      {"simulated", {{"Description", kSimulatedMeaning}}}};
  for (const QuestionnaireItem& item : items) {
    if (item.stage != stage) continue;
    names.push_back(item.name);
    sidecar[item.name] = sidecar_of(item, described_item(item));
  }
  CsvTableWriter table(folder / (label + ".tsv"), names, TableStyle::kBids);
  for (const auto& [participant, subject] : dataset.subjects) {
    table.cell("sub-" + subject).cell(is_simulated(dataset, participant));
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

/// A column of participants.tsv that answers fill.
struct PersonColumn {
  std::string name;
  QuestionnaireItem item;
  /// Where the answer is from, such as ", as answered in the stage about_you".
  std::string words;
};

bool has_column(const std::vector<PersonColumn>& columns, const std::string& name) {
  return std::ranges::find(columns, name, &PersonColumn::name) != columns.end();
}

/// The fields of the study come first, by which people were assigned. Then come the columns
/// that BIDS expects in the list of participants, if a questionnaire asks for them and no field
/// has that name. Their answers are in phenotype/ as well.
std::vector<PersonColumn> person_columns(const std::vector<QuestionnaireItem>& fields,
                                         const std::vector<QuestionnaireItem>& items,
                                         const std::vector<std::string>& taken) {
  constexpr std::pair<const char*, const char*> kItems[] = {{"age", "age"},
                                                            {"age_years", "age"},
                                                            {"sex", "sex"},
                                                            {"gender", "gender"},
                                                            {"handedness", "handedness"}};
  std::vector<PersonColumn> columns;
  for (const QuestionnaireItem& field : fields) {
    columns.push_back(
        {field_column(field.name, taken), field, ", as was known before the session"});
  }
  for (const auto& [item_name, column_name] : kItems) {
    const auto item = std::ranges::find(items, item_name, &QuestionnaireItem::name);
    if (item == items.end() || has_column(columns, column_name)) continue;
    columns.push_back({column_name, *item, ", as answered in the stage " + item->stage});
  }
  return columns;
}

}  // namespace

void write_bids_sessions(const fs::path& folder, const std::string& subject,
                         const std::vector<std::pair<std::string, core::SessionRow>>& sessions,
                         const core::StudyStore& store) {
  std::vector<CsvColumn> columns = {{"session_id", "", "Label of the visit"}};
  columns.insert(columns.end(), session_columns().begin(), session_columns().end());
  const fs::path front = folder / (subject + "_sessions");
  CsvTableWriter table(front.string() + ".tsv", columns, TableStyle::kBids);
  for (const auto& [label, session] : sessions) {
    table.cell(label);
    write_session(table, session, store.completed(session.session),
                  store.events(session.session));
  }
  table.finish();
  write_json(front.string() + ".json", described(columns));
}

void write_bids_participants(const fs::path& folder, const BidsDataset& dataset,
                             const core::StudyStore& store) {
  std::vector<QuestionnaireItem> items, fields;
  for (const experiments::Study& study : dataset.studies) {
    merge_items(items, questionnaire_items(study));
    merge_items(fields, participant_fields(study));
  }
  std::vector<std::string> names = {"participant_id", "pseudonym", "data_origin",
                                    "num_sessions"};
  const std::vector<PersonColumn> asked = person_columns(fields, items, names);
  for (const PersonColumn& column : asked) names.emplace_back(column.name);
  CsvTableWriter table(folder / "participants.tsv", names, TableStyle::kBids);
  for (const auto& [participant, subject] : dataset.subjects) {
    const std::int64_t num_sessions =
        std::ranges::count(dataset.sessions, participant, &core::SessionRow::participant);
    const bool simulated = is_simulated(dataset, participant);
    table.cell("sub-" + subject).cell(participant).cell(simulated ? "SIMULATED" : "person");
    table.cell(num_sessions);
    for (const PersonColumn& column : asked) {
      table.cell(answer_of(store, dataset, participant, column.item));
    }
    table.end_row();
  }
  table.finish();
  ordered_json sidecar =
      described({{"participant_id", "", "Label of the participant in this data set"},
                 {"pseudonym", "", "As the study has it"},
                 {"data_origin", "", "SIMULATED: a model in a program; person"},
                 {"num_sessions", "", "Visits in this data set"}});
  for (const PersonColumn& column : asked) {
    sidecar[column.name] = sidecar_of(column.item, described_item(column.item) + column.words);
  }
  write_json(folder / "participants.json", sidecar);
  write_phenotypes(folder, items, dataset, store);
}

}  // namespace jnd::analysis
