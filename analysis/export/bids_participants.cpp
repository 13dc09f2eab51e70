#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/data/questionnaire_items.h"
#include "analysis/export/bids_dataset.h"
#include "analysis/export/bids_text.h"
#include "analysis/export/csv_table_writer.h"
#include "analysis/export/study_tables.h"
#include "analysis/export/table_rows.h"
#include "core/storage/acknowledgement.h"

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

/// All answers of each participant outside of trials, in the order of the sessions.
std::map<std::string, std::vector<core::AnswerRow>> answers_of_all(
    const core::StudyStore& store, const BidsDataset& dataset) {
  std::map<std::string, std::vector<core::AnswerRow>> all;
  for (const core::SessionRow& session : dataset.sessions) {
    std::vector<core::AnswerRow> its = store.answers(session.session);
    std::ranges::move(its, std::back_inserter(all[session.participant]));
  }
  return all;
}

/// The last answer given in the visits of a participant; "" if there is none.
std::string answer_of(const std::vector<core::AnswerRow>& answers,
                      const QuestionnaireItem& item) {
  const auto last = std::find_if(answers.rbegin(), answers.rend(), [&](const auto& row) {
    return row.stage == item.stage && row.item == item.name && !row.answer.empty();
  });
  return last == answers.rend() ? "" : last->answer;
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
  const std::map<std::string, std::vector<core::AnswerRow>> answers =
      answers_of_all(store, dataset);
  // How often the stage came in a session: an item has a column for each time.
  std::size_t num_times = 1;
  for (const QuestionnaireItem& item : items) {
    if (item.stage != stage) continue;
    for (const auto& [participant, its] : answers) {
      num_times = std::max(num_times, answers_by_time(its, item).size());
    }
  }
  for (const QuestionnaireItem& item : items) {
    if (item.stage != stage) continue;
    for (std::size_t time = 1; time <= num_times; ++time) {
      const std::string number = std::to_string(time);
      const std::string name = item.name + (num_times == 1 ? "" : "_time_" + number);
      names.push_back(name);
      sidecar[name] = sidecar_of(
          item,
          described_item(item) +
              (num_times == 1 ? "" : ", time " + number + " of " + std::to_string(num_times)));
    }
  }
  CsvTableWriter table(folder / (label + ".tsv"), names, TableStyle::kBids);
  for (const auto& [participant, subject] : dataset.subjects) {
    table.cell("sub-" + subject).cell(is_simulated(dataset, participant));
    const auto its = answers.find(participant);
    for (const QuestionnaireItem& item : items) {
      if (item.stage != stage) continue;
      std::vector<std::string> by_time;
      if (its != answers.end()) by_time = answers_by_time(its->second, item);
      by_time.resize(num_times);
      for (const std::string& answer : by_time) table.cell(answer);
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

/// Of each note, fault and adverse event that somebody has read, the session that it is of.
std::vector<std::int64_t> sessions_of_acknowledgements(const core::StudyStore& store) {
  std::map<std::int64_t, std::int64_t> of_adverse_event;
  for (const core::AdverseEventRow& row : store.adverse_events()) {
    of_adverse_event[row.adverse_event] = row.session;
  }
  std::vector<std::int64_t> sessions;
  for (const core::Acknowledgement& one : core::acknowledgements(store.folder())) {
    sessions.push_back(one.what.adverse_event == 0 ? one.what.session
                                                   : of_adverse_event[one.what.adverse_event]);
  }
  return sessions;
}

}  // namespace

void write_bids_sessions(const fs::path& folder, const std::string& subject,
                         const std::vector<std::pair<std::string, core::SessionRow>>& sessions,
                         const core::StudyStore& store) {
  std::vector<CsvColumn> columns = {
      {"session_id", "", "Label of the visit"},
      {"num_set_aside", "", "Answered trials that are set aside"},
      {"num_acknowledged", "",
       "Notes, faults and adverse events of the visit that somebody has marked as read"}};
  const std::vector<std::int64_t> acknowledged = sessions_of_acknowledgements(store);
  columns.insert(columns.end(), session_columns().begin(), session_columns().end());
  const fs::path front = folder / (subject + "_sessions");
  CsvTableWriter table(front.string() + ".tsv", columns, TableStyle::kBids);
  for (const auto& [label, session] : sessions) {
    table.cell(label);
    table.cell(std::ssize(store.trials(session.session, /*include_excluded=*/true)) -
               std::ssize(store.trials(session.session)));
    table.cell(std::int64_t{std::ranges::count(acknowledged, session.session)});
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
  std::map<std::string, std::vector<core::AnswerRow>> answers = answers_of_all(store, dataset);
  CsvTableWriter table(folder / "participants.tsv", names, TableStyle::kBids);
  for (const auto& [participant, subject] : dataset.subjects) {
    const std::int64_t num_sessions =
        std::ranges::count(dataset.sessions, participant, &core::SessionRow::participant);
    const bool simulated = is_simulated(dataset, participant);
    table.cell("sub-" + subject).cell(participant).cell(simulated ? "SIMULATED" : "person");
    table.cell(num_sessions);
    for (const PersonColumn& column : asked) {
      table.cell(answer_of(answers[participant], column.item));
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
