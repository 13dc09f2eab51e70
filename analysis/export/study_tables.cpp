#include "analysis/export/study_tables.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "analysis/data/cell_arms.h"
#include "analysis/export/table_columns.h"
#include "core/storage/sha256.h"

namespace jnd::analysis {
namespace {

using enum ColumnType;

template <typename Cells>
typename Columns<Cells>::iterator place_of(Columns<Cells>& columns, std::string_view name) {
  return std::ranges::find(columns, name,
                           [](const auto& one) { return std::string_view(one.column.name); });
}

/// Inserts a column after the one with this name.
template <typename Cells>
void insert_after(Columns<Cells>& columns, std::string_view name, Column<Cells> column) {
  columns.insert(std::next(place_of(columns, name)), std::move(column));
}

/// Puts the columns that say whose the row is before the others. `Cells` has the session.
template <typename Cells>
Columns<Cells> owned(Columns<Cells> columns) {
  Columns<Cells> all = stored_columns<Cells>(
      [](const Cells& it) -> const core::SessionRow& { return it.session; });
  all.erase(std::next(place_of(all, "simulated")), all.end());
  std::ranges::move(columns, std::back_inserter(all));
  return all;
}

using NamedValues = std::map<std::string, std::string>;

/// What the participant was assigned and had at the start.
struct SessionStart {
  std::string language;
  NamedValues fields, fitting;
};

/// For example "hand=left;sex=female".
std::string packed(const NamedValues& values) {
  std::string text;
  for (const auto& [name, value] : values) {
    text += (text.empty() ? "" : ";") + name + "=" + value;
  }
  return text;
}

/// The result is empty if the session has not begun or does not say.
SessionStart start_of(const std::vector<core::EventRow>& events) {
  SessionStart start;
  for (const core::EventRow& event : events) {
    if (event.kind != "session_started" && event.kind != "fitting_kept") continue;
    const auto data = nlohmann::json::parse(event.data, nullptr, false);
    if (!data.is_object()) continue;
    if (event.kind == "fitting_kept") {
      start.fitting = data.value("fitting", NamedValues{});
    } else {
      start.language = data.value("language", "");
      start.fields = data.value("fields", NamedValues{});
    }
  }
  return start;
}

// The following structs hold the data of a row of each table.

struct SessionCells {
  const core::SessionRow& session;
  bool completed = false;
  SessionStart start;
};
struct SessionValueCells {
  const core::SessionRow& session;
  const char* kind;
  const std::string& name;
  const std::string& value;
};
struct TrialCells {
  const core::SessionRow& session;
  const ExportedTrial& trial;
};
struct PresentationCells {
  const core::SessionRow& session;
  const ExportedPresentation& presentation;
};
struct EventCells {
  const core::SessionRow& session;
  const core::EventRow& row;
};
struct AnswerCells {
  const core::SessionRow& session;
  const core::AnswerRow& row;
};
struct QuestionCells {
  const core::SessionRow& session;
  const QuestionnaireItem& item;
  std::string given;
  std::optional<std::int64_t> stage_index;
};
struct QuestionAnswerCells {
  const core::SessionRow& session;
  const ExportedAnswer& answer;
};
struct MarkerCells {
  const core::SessionRow& session;
  std::int64_t code = 0;
  double monotonic_s = 0.0, uncertainty_s = 0.0;
  const core::EventRow* event = nullptr;  ///< nullptr marks the end.
};
struct GapCells {
  const core::SessionRow& session;
  core::TickRange gap;
  std::int64_t num_missed = 0;
};

const Columns<SessionCells>& session_table() {
  static const Columns<SessionCells> kColumns = [] {
    auto all = stored_columns<SessionCells>(
        [](const SessionCells& it) -> const core::SessionRow& { return it.session; });
    insert_after(all, "pilot",
                 {{"completed", "", "1: every stage was run", kCount},
                  [](auto& to, const auto& it) { to.cell(it.completed); }});
    insert_after(all, "protocol_sha256",
                 {{"language", "",
                   "Of the texts that the participant got; empty where nobody read them"},
                  [](auto& to, const auto& it) { to.cell(it.start.language); }});
    insert_after(
        all, "language",
        {{"fields", "",
          "What was known of the participant before, as in sex=female;hand=left; empty "
          "where nothing was asked"},
         [](auto& to, const auto& it) { to.cell(packed(it.start.fields)); }});
    insert_after(
        all, "fields",
        {{"fitting", "",
          "How the device was fitted to the participant, as in glove=M;thumb=thin pad; "
          "empty where nobody said. The event fitting_kept has where the points were"},
         [](auto& to, const auto& it) { to.cell(packed(it.start.fitting)); }});
    *place_of(all, "laboratory") = {
        {"laboratory_sha256", "",
         "Of the simulated participants' laboratory, which is beside the tables; empty: "
         "people"},
        [](auto& to, const auto& it) {
          const std::string& laboratory = it.session.laboratory;
          to.cell(laboratory.empty() ? std::string() : core::sha256(laboratory));
        }};
    return all;
  }();
  return kColumns;
}

const Columns<SessionValueCells>& session_value_table() {
  static const Columns<SessionValueCells> kColumns = owned(Columns<SessionValueCells>{
      {{"kind", "",
        "field: what was known of the participant before; arm: what a counterbalance gave "
        "them; fitting: how the device was fitted to them"},
       [](auto& to, const auto& it) { to.cell(it.kind); }},
      {{"name", "", "Of the field, of the counterbalance, of the part that was fitted"},
       [](auto& to, const auto& it) { to.cell(it.name); }},
      {{"value", "", "As it was given or drawn"},
       [](auto& to, const auto& it) { to.cell(it.value); }},
  });
  return kColumns;
}

const Columns<TrialCells>& trial_table() {
  static const Columns<TrialCells> kColumns = [] {
    auto all = owned(stored_columns<TrialCells>(
        [](const TrialCells& it) -> const core::TrialRow& { return it.trial.row; }));
    insert_after(all, "is_catch",
                 {{"is_practice", "", "1: of a practice block, not for analysis", kCount},
                  [](auto& to, const auto& it) { to.cell(it.trial.is_practice); }});
    insert_after(all, "reference_intensity",
                 {{"standard_medium", "", "What the reference stimulus is; empty: the medium"},
                  [](auto& to, const auto& it) { to.cell(it.trial.standard_medium); }});
    // The meaning of `response` depends on the procedure. Each of these columns has one
    // meaning.
    using enum experiments::Measure;
    struct Answer {
      experiments::Measure measure;
      CsvColumn column;
    };
    for (const Answer& one :
         {Answer{kMagnitude,
                 {"magnitude", "", "Number that was given for how strong it feels", kReal}},
          {kRating, {"rating", "", "Step of the scale, from 1", kReal}},
          {kProducedMagnitude,
           {"produced_intensity", "unit of quantity", "Set to feel like target_percent",
            kReal}},
          {kMatch,
           {"matched_intensity", "unit of quantity", "Set to feel like the standard", kReal}},
          {kComparison,
           {"is_test_chosen", "", "1: the test was chosen, 0: the reference", kReal}},
          {kDetection, {"is_felt", "", "1: yes, it is felt, 0: no", kReal}},
          {kDifference, {"is_called_different", "", "1: different, 0: the same", kReal}},
          {kIdentification, {"is_right", "", "1: the right interval, 0: another", kReal}}}) {
      all.push_back({one.column, [measure = one.measure](auto& to, const auto& it) {
                       to.cell(it.trial.response_if(measure));
                     }});
    }
    all.push_back(
        {{"excluded", "", "1: set aside; the event trial_excluded has the reason", kCount},
         [](auto& to, const auto& it) { to.cell(it.trial.excluded); }});
    return all;
  }();
  return kColumns;
}

const Columns<PresentationCells>& presentation_table() {
  static const Columns<PresentationCells> kColumns = [] {
    auto all = owned(stored_columns<PresentationCells>(
        [](const PresentationCells& it) -> const core::PresentationRow& {
          return it.presentation.row;
        }));
    insert_after(all, "trial",
                 {{"block", "", "Block of the study file that its trial belongs to"},
                  [](auto& to, const auto& it) { to.cell(it.presentation.block); }});
    all.push_back({{"excluded", "", "1: its trial is set aside", kCount},
                   [](auto& to, const auto& it) { to.cell(it.presentation.excluded); }});
    return all;
  }();
  return kColumns;
}

const Columns<EventCells>& event_table() {
  static const Columns<EventCells> kColumns = owned(stored_columns<EventCells>(
      [](const EventCells& it) -> const core::EventRow& { return it.row; }));
  return kColumns;
}

const Columns<AnswerCells>& answer_table() {
  static const Columns<AnswerCells> kColumns = owned(stored_columns<AnswerCells>(
      [](const AnswerCells& it) -> const core::AnswerRow& { return it.row; }));
  return kColumns;
}

const Columns<QuestionCells>& questionnaire_table() {
  static const Columns<QuestionCells> kColumns = owned(Columns<QuestionCells>{
      {{"stage", "", "Name of the questionnaire in the study file"},
       [](auto& to, const auto& it) { to.cell(it.item.stage); }},
      {{"item", "", "Name of the question in the study file"},
       [](auto& to, const auto& it) { to.cell(it.item.name); }},
      {{"kind", "",
        "How it is answered: number, text, choice, yes_no, yes_no_which, scale, words"},
       [](auto& to, const auto& it) { to.cell(it.item.kind); }},
      {{"question", "", "As it was asked, in English where the study has it"},
       [](auto& to, const auto& it) { to.cell(it.item.question); }},
      {{"unit", "", "Of a number"}, [](auto& to, const auto& it) { to.cell(it.item.unit); }},
      {{"num_steps", "", "Of a scale, which begins at 1", kReal},
       [](auto& to, const auto& it) {
         to.cell(it.item.num_steps > 0 ? std::optional<std::int64_t>(it.item.num_steps)
                                       : std::nullopt);
       }},
      {{"answer", "", "As it was given, the last one if corrected; empty: none"},
       [](auto& to, const auto& it) { to.cell(it.given); }},
      {{"stage_index", "",
        "Place of the questionnaire in the participant's list of stages, from 0; one that came "
        "several times has a row for each. Empty: no answer",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.stage_index); }},
  });
  return kColumns;
}

const Columns<QuestionAnswerCells>& question_table() {
  static const Columns<QuestionAnswerCells> kColumns = [] {
    auto all = owned(stored_columns<QuestionAnswerCells>(
        [](const QuestionAnswerCells& it) -> const core::QuestionAnswerRow& {
          return it.answer.row;
        }));
    insert_after(
        all, "question",
        {{"kind", "", "How it is answered: number, text, choice, yes_no, yes_no_which, scale"},
         [](auto& to, const auto& it) { to.cell(it.answer.kind); }});
    all.push_back(
        {{"value", "unit", "The number, or the step of the scale; empty otherwise", kReal},
         [](auto& to, const auto& it) { to.cell(it.answer.value); }});
    all.push_back({{"unit", "", "Of a number"},
                   [](auto& to, const auto& it) { to.cell(it.answer.unit); }});
    all.push_back({{"excluded", "", "1: its trial is set aside", kCount},
                   [](auto& to, const auto& it) { to.cell(it.answer.excluded); }});
    return all;
  }();
  return kColumns;
}

const Columns<MarkerCells>& marker_table() {
  static const Columns<MarkerCells> kColumns = owned(Columns<MarkerCells>{
      {{"code", "", "Of the pulse, as the study file has it for each kind of event", kCount},
       [](auto& to, const auto& it) { to.cell(it.code); }},
      {{"monotonic_s", "s",
        "When the pulse began, at the earliest: by CLOCK_MONOTONIC, as monotonic_s of samples",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.monotonic_s); }},
      {{"uncertainty_s", "s", "By which it can have begun later", kReal},
       [](auto& to, const auto& it) { to.cell(it.uncertainty_s); }},
      {{"event", "", "Sequence of the event that it tells of; empty: the end of the session",
        kReal},
       [](auto& to, const auto& it) {
         to.cell(it.event == nullptr ? std::nullopt : std::optional(it.event->sequence));
       }},
      {{"kind", "", "Of that event; empty: the end of the session"},
       [](auto& to, const auto& it) {
         to.cell(it.event == nullptr ? std::string() : it.event->kind);
       }},
      {{"trial", "", "Running number in the session; empty: of none", kReal},
       [](auto& to, const auto& it) {
         to.cell(it.event == nullptr ? std::nullopt : it.event->trial);
       }},
      {{"attempt", "", "1 is the first", kReal},
       [](auto& to, const auto& it) {
         to.cell(it.event == nullptr ? std::nullopt : it.event->attempt);
       }},
  });
  return kColumns;
}

/// The pulses in a `markers_sent` event; none if the event is damaged.
std::vector<MarkerCells> pulses_in(const core::SessionRow& session, const core::EventRow& row,
                                   const std::vector<core::EventRow>& events) {
  std::vector<MarkerCells> pulses;
  const auto data = nlohmann::json::parse(row.data, nullptr, false);
  if (!data.is_object() || !data.contains("pulses")) return pulses;
  for (const nlohmann::json& one : data["pulses"]) {
    if (!one.is_array() || one.size() != 4 || !one[0].is_number_integer() ||
        !one[1].is_number_integer() || !one[2].is_number() || !one[3].is_number()) {
      continue;
    }
    const auto told =
        std::ranges::find(events, one[0].get<std::int64_t>(), &core::EventRow::sequence);
    pulses.push_back({.session = session,
                      .code = one[1].get<std::int64_t>(),
                      .monotonic_s = one[2].get<double>(),
                      .uncertainty_s = one[3].get<double>(),
                      .event = told == events.end() ? nullptr : &*told});
  }
  return pulses;
}

const Columns<GapCells>& gap_table() {
  static const Columns<GapCells> kColumns = owned(Columns<GapCells>{
      {{"first_tick", "tick", "First tick without a sample", kCount},
       [](auto& to, const auto& it) { to.cell(it.gap.first_tick); }},
      {{"last_tick", "tick", "Last tick without a sample; nothing is filled in", kCount},
       [](auto& to, const auto& it) { to.cell(it.gap.last_tick); }},
      {{"missed_ticks", "ticks",
        "Those that never ran, for the loop was held up; others are lost", kCount},
       [](auto& to, const auto& it) { to.cell(it.num_missed); }},
  });
  return kColumns;
}

}  // namespace

const std::vector<CsvColumn>& session_columns() {
  static const std::vector<CsvColumn> kColumns = told(session_table());
  return kColumns;
}

const std::vector<CsvColumn>& session_value_columns() {
  static const std::vector<CsvColumn> kColumns = told(session_value_table());
  return kColumns;
}

const std::vector<CsvColumn>& trial_columns() {
  static const std::vector<CsvColumn> kColumns = told(trial_table());
  return kColumns;
}

const std::vector<CsvColumn>& presentation_columns() {
  static const std::vector<CsvColumn> kColumns = told(presentation_table());
  return kColumns;
}

const std::vector<CsvColumn>& event_columns() {
  static const std::vector<CsvColumn> kColumns = told(event_table());
  return kColumns;
}

const std::vector<CsvColumn>& answer_columns() {
  static const std::vector<CsvColumn> kColumns = told(answer_table());
  return kColumns;
}

const std::vector<CsvColumn>& questionnaire_columns() {
  static const std::vector<CsvColumn> kColumns = told(questionnaire_table());
  return kColumns;
}

const std::vector<CsvColumn>& question_columns() {
  static const std::vector<CsvColumn> kColumns = told(question_table());
  return kColumns;
}

const std::vector<CsvColumn>& marker_columns() {
  static const std::vector<CsvColumn> kColumns = told(marker_table());
  return kColumns;
}

const std::vector<CsvColumn>& gap_columns() {
  static const std::vector<CsvColumn> kColumns = told(gap_table());
  return kColumns;
}

const std::vector<CsvColumn>& participant_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"num_sessions", "", "Visits in this data set", kCount},
      {"num_completed_sessions", "", "Of them, those in which every stage was run", kCount},
      {"num_trials", "", "Trials whose answer stands, those set aside among them", kCount},
      {"num_excluded_trials", "", "Of them, those set aside with a reason", kCount},
  };
  return kColumns;
}

const std::vector<CsvColumn>& codebook_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"file", "", "Table that has the column"},
      {"column", "", "Name of the column"},
      {"unit", "", "Of its numbers; empty: none"},
      {"meaning", "", "What it says"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& deviation_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"topic", "", "What is not as it was registered before anybody took part"},
      {"planned", "", "As the preregistration has it"},
      {"found", "", "As the study has it"},
      {"registered_on", "", "Day of the preregistration"},
      {"preregistration_sha256", "", "Identifies the preregistration"},
  };
  return kColumns;
}

void write_deviations(TableWriter& table, const PreregisteredStudy& preregistration) {
  for (const Deviation& one : preregistration.deviations) {
    table.cell(one.topic).cell(one.planned).cell(one.found);
    table.cell(preregistration.registered_on).cell(preregistration.sha256).end_row();
  }
}

void write_session(TableWriter& table, const core::SessionRow& session, bool completed,
                   const std::vector<core::EventRow>& events) {
  put(table, session_table(), {session, completed, start_of(events)}).end_row();
}

void write_session_values(TableWriter& table, const core::SessionRow& session,
                          const std::vector<core::EventRow>& events) {
  const SessionStart start = start_of(events);
  const NamedValues arms = arms_of(session.cells);
  for (const auto& [kind, values] : {std::pair<const char*, const NamedValues*>("arm", &arms),
                                     {"field", &start.fields},
                                     {"fitting", &start.fitting}}) {
    for (const auto& [name, value] : *values) {
      put(table, session_value_table(), {session, kind, name, value}).end_row();
    }
  }
}

void write_trial_cells(TableWriter& table, const core::SessionRow& session,
                       const ExportedTrial& trial, FactorColumns& factors) {
  put(table, trial_table(), {session, trial}, kNumTrialOwners);
  factors.put(table, session, trial);
}

void write_trials(TableWriter& table, const core::SessionRow& session,
                  const std::vector<ExportedTrial>& trials, FactorColumns& factors) {
  for (const ExportedTrial& trial : trials) {
    put(table, trial_table(), {session, trial});
    factors.put(table, session, trial);
    table.end_row();
  }
}

void write_presentations(TableWriter& table, const core::SessionRow& session,
                         const std::vector<ExportedPresentation>& presentations) {
  for (const ExportedPresentation& one : presentations) {
    put(table, presentation_table(), {session, one}).end_row();
  }
}

void write_events(TableWriter& table, const core::SessionRow& session,
                  const std::vector<core::EventRow>& events) {
  for (const core::EventRow& row : events) put(table, event_table(), {session, row}).end_row();
}

void write_answers(TableWriter& table, const core::SessionRow& session,
                   const std::vector<core::AnswerRow>& answers) {
  for (const core::AnswerRow& row : answers)
    put(table, answer_table(), {session, row}).end_row();
}

void write_questionnaire(TableWriter& table, const core::SessionRow& session,
                         const std::vector<core::AnswerRow>& answers,
                         const std::vector<QuestionnaireItem>& questions) {
  for (const QuestionnaireItem& item : questions) {
    std::map<std::optional<std::int64_t>, std::string> given;  // By the place of the stage.
    for (const core::AnswerRow& row : answers) {
      if (row.stage != item.stage) continue;
      std::string& its = given[row.stage_index];
      if (row.item == item.name) its = row.answer;
    }
    if (given.empty()) given[std::nullopt] = "";
    for (const auto& [stage_index, answer] : given) {
      put(table, questionnaire_table(), {session, item, answer, stage_index}).end_row();
    }
  }
}

void write_questions(TableWriter& table, const core::SessionRow& session,
                     const std::vector<ExportedAnswer>& answers) {
  for (const ExportedAnswer& one : answers)
    put(table, question_table(), {session, one}).end_row();
}

void write_question_cells(TableWriter& table, const core::SessionRow& session,
                          const ExportedAnswer& answer) {
  put(table, question_table(), {session, answer}, kNumTrialOwners);
}

void write_markers(TableWriter& table, const core::SessionRow& session,
                   const std::vector<core::EventRow>& events) {
  for (const core::EventRow& row : events) {
    if (row.kind != "markers_sent") continue;
    for (const MarkerCells& pulse : pulses_in(session, row, events)) {
      put(table, marker_table(), pulse).end_row();
    }
  }
}

void write_gaps(TableWriter& table, const core::SessionRow& session,
                const ExportedRecording& recording) {
  for (const core::TickRange& gap : recording.gaps()) {
    put(table, gap_table(), {session, gap, recording.num_missed(gap)}).end_row();
  }
}

void write_codebook(
    TableWriter& table,
    const std::vector<std::pair<std::string, const std::vector<CsvColumn>*>>& tables) {
  for (const auto& [name, columns] : tables) {
    for (const CsvColumn& column : *columns) {
      table.cell(name).cell(column.name).cell(column.unit).cell(column.meaning).end_row();
    }
  }
}

}  // namespace jnd::analysis
