#include "analysis/export/study_tables.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>

namespace jnd::analysis {
namespace {

using enum ColumnType;

/// A column of a table: how the codebook tells it, and what a row puts there. So a column is
/// one line, for CSV, BIDS, HDF5 and the codebook alike.
template <typename Row>
struct Column {
  CsvColumn column;
  void (*put)(TableWriter& to, const Row& it);
};
template <typename Row>
using Columns = std::vector<Column<Row>>;

template <typename Row>
std::vector<CsvColumn> told(const Columns<Row>& columns) {
  std::vector<CsvColumn> all;
  for (const Column<Row>& one : columns) all.push_back(one.column);
  return all;
}

/// The cells of a row from the column `first` on.
template <typename Row>
TableWriter& put(TableWriter& table, const Columns<Row>& columns, const Row& row,
                 std::size_t first = 0) {
  for (std::size_t i = first; i < columns.size(); ++i) columns[i].put(table, row);
  return table;
}

/// On one line, so that tools which know no quoted line ends read the table, too.
std::string on_one_line(const std::string& json_text) {
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(json_text, nullptr, false);
  return json.is_discarded() ? json_text : json.dump();
}

/// What the participant got and brought.
struct SessionStart {
  std::string language, fields;
};

/// Empty where the session has not begun, or does not say.
SessionStart start_of(const std::vector<core::EventRow>& events) {
  SessionStart start;
  for (const core::EventRow& event : events) {
    if (event.kind != "session_started") continue;
    const auto data = nlohmann::json::parse(event.data, nullptr, false);
    if (!data.is_object()) return start;
    start.language = data.value("language", "");
    const auto fields = data.value("fields", std::map<std::string, std::string>{});
    for (const auto& [name, value] : fields) {
      start.fields += (start.fields.empty() ? "" : ";") + name + "=" + value;
    }
    return start;
  }
  return start;
}

// What a row of each table is made of.

struct SessionCells {
  const core::SessionRow& session;
  bool completed = false;
  SessionStart start;
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
};
struct GapCells {
  const core::SessionRow& session;
  core::TickRange gap;
  std::int64_t num_missed = 0;
};

const Columns<SessionCells>& session_table() {
  static const Columns<SessionCells> kColumns = {
      {{"session", "", "Number of the session in the study", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.session); }},
      {{"participant", "", "Pseudonym"},
       [](auto& to, const auto& it) { to.cell(it.session.participant); }},
      {{"simulated", "", "1: SIMULATED participant and apparatus", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.simulated); }},
      {{"cells", "", "Counterbalancing: which arms in which order"},
       [](auto& to, const auto& it) { to.cell(it.session.cells); }},
      {{"seed", "", "Of everything drawn in the session; 64 bits, so read it as text"},
       [](auto& to, const auto& it) { to.cell(std::to_string(it.session.seed)); }},
      {{"pilot", "", "1: a pilot, not for analysis", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.pilot); }},
      {{"completed", "", "1: every stage was run", kCount},
       [](auto& to, const auto& it) { to.cell(it.completed); }},
      {{"device", "", "Name of the device"},
       [](auto& to, const auto& it) { to.cell(it.session.device); }},
      {{"rate_hz", "Hz", "Rate of the haptic loop and of the recording", kReal},
       [](auto& to, const auto& it) { to.cell(it.session.rate_hz); }},
      {{"realtime", "", "What the loop was given by the system"},
       [](auto& to, const auto& it) { to.cell(it.session.realtime); }},
      {{"recorded", "", "1: samples are kept", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.recorded); }},
      {{"program_version", "", "Of the jnd that ran the session"},
       [](auto& to, const auto& it) { to.cell(it.session.program_version); }},
      {{"protocol_sha256", "", "Identifies the study file"},
       [](auto& to, const auto& it) { to.cell(it.session.protocol_sha256); }},
      {{"language", "", "Of the texts that the participant got; empty where nobody read them"},
       [](auto& to, const auto& it) { to.cell(it.start.language); }},
      {{"fields", "",
        "What was known of the participant before, as in sex=female;hand=left; empty where "
        "nothing was asked"},
       [](auto& to, const auto& it) { to.cell(it.start.fields); }},
      {{"started_time_ns", "ns", "Since 1970-01-01 UTC; a simulated session counts from 0",
        kCount},
       [](auto& to, const auto& it) { to.cell(it.session.started_time_ns); }},
      {{"laboratory", "", "Who and what was simulated, as JSON; empty with a person"},
       [](auto& to, const auto& it) { to.cell(on_one_line(it.session.laboratory)); }},
  };
  return kColumns;
}

const Columns<TrialCells>& trial_table() {
  static const Columns<TrialCells> kColumns = {
      {{"session", "", "Number of the session in the study", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.session); }},
      {{"participant", "", "Pseudonym"},
       [](auto& to, const auto& it) { to.cell(it.session.participant); }},
      {{"simulated", "", "1: SIMULATED participant and apparatus", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.simulated); }},
      {{"trial", "", "Running number in the session, from 1", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.trial); }},
      {{"attempt", "", "1, or more if the trial was repeated", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.attempt); }},
      {{"block", "", "Name of the block in the study file"},
       [](auto& to, const auto& it) { to.cell(it.trial.row.block); }},
      {{"procedure", "", "How the block asks"},
       [](auto& to, const auto& it) { to.cell(it.trial.row.procedure); }},
      {{"medium", "", "What was rendered"},
       [](auto& to, const auto& it) { to.cell(it.trial.row.medium); }},
      {{"quantity", "",
        "What intensities mean: scale (ratio), viscosity_pa_s (Pa s) or stiffness_n_per_m "
        "(N/m)"},
       [](auto& to, const auto& it) { to.cell(it.trial.row.quantity); }},
      {{"repetition", "", "From 1; in each, every stimulus once", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.repetition); }},
      {{"position", "", "Within the repetition, from 1", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.position); }},
      {{"series", "", "Staircase or series of the block, from 1; empty where there is one",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.series); }},
      {{"test_interval", "",
        "Where the order is drawn: interval of the test stimulus, 1 or 2. The interval that "
        "was "
        "chosen in a two-interval task is test_interval where response is 1, else "
        "3 - test_interval",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.test_interval); }},
      {{"is_catch", "",
        "1: a catch trial, in which nothing is there or the test equals the reference", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.is_catch); }},
      {{"is_practice", "", "1: of a practice block, not for analysis", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.is_practice); }},
      {{"intensity", "unit of quantity", "Test stimulus; of an adjustment the value set",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.intensity); }},
      {{"reference_intensity", "unit of quantity",
        "Reference stimulus; of a block with a standard_medium in the unit of that medium's "
        "quantity",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.reference_intensity); }},
      {{"standard_medium", "", "What the reference stimulus is; empty: the medium"},
       [](auto& to, const auto& it) { to.cell(it.trial.standard_medium); }},
      {{"starting_intensity", "unit of quantity",
        "Production and matching: where the adjustment began", kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.starting_intensity); }},
      {{"target_percent", "%", "Production: what it should feel like, water being 100", kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.target_percent); }},
      {{"response", "",
        "Percent, or a number in another modulus; 1: yes, different, or the interval of the "
        "test, 0: otherwise; of an adjustment the value set",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.response); }},
      {{"response_time_s", "s",
        "From the start of the last stimulus to the answer; where one is adjusted, from the "
        "start "
        "of that",
        kReal},
       [](auto& to, const auto& it) { to.cell(it.trial.row.response_time_s); }},
      {{"num_presentations", "", "Stimuli felt in this attempt", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.num_presentations); }},
      {{"num_steps", "", "Production and matching: steps of adjustment", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.num_steps); }},
      {{"first_tick", "tick", "First sample of the trial in the recording", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.first_tick); }},
      {{"last_tick", "tick", "Last sample of the trial in the recording", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.row.last_tick); }},
      {{"excluded", "", "1: set aside; the event trial_excluded has the reason", kCount},
       [](auto& to, const auto& it) { to.cell(it.trial.excluded); }},
  };
  return kColumns;
}

const Columns<PresentationCells>& presentation_table() {
  static const Columns<PresentationCells> kColumns = {
      {{"session", "", "Number of the session in the study", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.session); }},
      {{"participant", "", "Pseudonym"},
       [](auto& to, const auto& it) { to.cell(it.session.participant); }},
      {{"simulated", "", "1: SIMULATED participant and apparatus", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.simulated); }},
      {{"trial", "", "Running number in the session", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.trial); }},
      {{"attempt", "", "Attempt whose answer stands", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.attempt); }},
      {{"presentation", "", "Within the attempt, from 1", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.presentation); }},
      {{"interval", "", "test, reference or free_space"},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.interval); }},
      {{"intensity", "unit of quantity", "What was presented", kReal},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.intensity); }},
      {{"first_tick", "tick", "First sample in the recording", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.first_tick); }},
      {{"last_tick", "tick", "Last sample in the recording", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.last_tick); }},
      {{"num_strokes", "", "Whole strokes: to a turning point and back", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.num_strokes); }},
      {{"stroke_width_m", "m", "Mean distance between turning points", kReal},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.stroke_width_m); }},
      {{"max_speed_m_per_s", "m/s", "Mean of the highest speed in each stroke", kReal},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.max_speed_m_per_s); }},
      {{"mean_height_m", "m", "Mean height of the hand, workspace frame", kReal},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.mean_height_m); }},
      {{"delivered_damping_n_s_per_m", "N s/m", "Delivered force over speed, regression slope",
        kReal},
       [](auto& to, const auto& it) {
         to.cell(it.presentation.row.delivered_damping_n_s_per_m);
       }},
      {{"commanded_damping_n_s_per_m", "N s/m", "Commanded; empty for water", kReal},
       [](auto& to, const auto& it) {
         to.cell(it.presentation.row.commanded_damping_n_s_per_m);
       }},
      {{"limited_ticks", "ticks", "Ticks in which the force limiter changed the force", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.limited_ticks); }},
      {{"missed_ticks", "ticks", "Ticks that were due and never ran", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.missed_ticks); }},
      {{"finger_lag_s", "s", "By which thumb, index and middle trail behind the palm", kReal},
       [](auto& to, const auto& it) { to.cell(it.presentation.row.finger_lag_s); }},
      {{"excluded", "", "1: its trial is set aside", kCount},
       [](auto& to, const auto& it) { to.cell(it.presentation.excluded); }},
  };
  return kColumns;
}

const Columns<EventCells>& event_table() {
  static const Columns<EventCells> kColumns = {
      {{"session", "", "Number of the session in the study", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.session); }},
      {{"participant", "", "Pseudonym"},
       [](auto& to, const auto& it) { to.cell(it.session.participant); }},
      {{"simulated", "", "1: SIMULATED participant and apparatus", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.simulated); }},
      {{"sequence", "", "1, 2, 3 ... in the order in which it happened", kCount},
       [](auto& to, const auto& it) { to.cell(it.row.sequence); }},
      {{"kind", "", "What happened"}, [](auto& to, const auto& it) { to.cell(it.row.kind); }},
      {{"version", "", "Of the layout of data", kCount},
       [](auto& to, const auto& it) { to.cell(std::int64_t{it.row.version}); }},
      {{"time_ns", "ns", "Since 1970-01-01 UTC; a simulated session counts from 0", kCount},
       [](auto& to, const auto& it) { to.cell(it.row.time_ns); }},
      {{"stage", "", "Place of the stage in the participant's list, from 0", kReal},
       [](auto& to, const auto& it) { to.cell(it.row.stage); }},
      {{"trial", "", "Running number in the session", kReal},
       [](auto& to, const auto& it) { to.cell(it.row.trial); }},
      {{"attempt", "", "1 is the first", kReal},
       [](auto& to, const auto& it) { to.cell(it.row.attempt); }},
      {{"first_tick", "tick", "In the recording", kReal},
       [](auto& to, const auto& it) { to.cell(it.row.first_tick); }},
      {{"last_tick", "tick", "In the recording", kReal},
       [](auto& to, const auto& it) { to.cell(it.row.last_tick); }},
      {{"intensity", "unit of quantity", "Presented or set", kReal},
       [](auto& to, const auto& it) { to.cell(it.row.intensity); }},
      {{"supersedes", "", "Sequence of the event that no longer counts", kReal},
       [](auto& to, const auto& it) { to.cell(it.row.supersedes); }},
      {{"data", "", "Everything else, as JSON"},
       [](auto& to, const auto& it) { to.cell(it.row.data); }},
  };
  return kColumns;
}

const Columns<AnswerCells>& answer_table() {
  static const Columns<AnswerCells> kColumns = {
      {{"session", "", "Number of the session in the study", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.session); }},
      {{"participant", "", "Pseudonym"},
       [](auto& to, const auto& it) { to.cell(it.session.participant); }},
      {{"simulated", "", "1: SIMULATED participant and apparatus", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.simulated); }},
      {{"stage", "", "Name of the stage in the study file"},
       [](auto& to, const auto& it) { to.cell(it.row.stage); }},
      {{"item", "", "Name of the question or point of a checklist"},
       [](auto& to, const auto& it) { to.cell(it.row.item); }},
      {{"answer", "", "As it was given; the last one if corrected"},
       [](auto& to, const auto& it) { to.cell(it.row.answer); }},
  };
  return kColumns;
}

const Columns<QuestionCells>& questionnaire_table() {
  static const Columns<QuestionCells> kColumns = {
      {{"session", "", "Number of the session in the study", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.session); }},
      {{"participant", "", "Pseudonym"},
       [](auto& to, const auto& it) { to.cell(it.session.participant); }},
      {{"simulated", "", "1: SIMULATED participant and apparatus", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.simulated); }},
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
  };
  return kColumns;
}

const Columns<GapCells>& gap_table() {
  static const Columns<GapCells> kColumns = {
      {{"session", "", "Number of the session in the study", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.session); }},
      {{"participant", "", "Pseudonym"},
       [](auto& to, const auto& it) { to.cell(it.session.participant); }},
      {{"simulated", "", "1: SIMULATED participant and apparatus", kCount},
       [](auto& to, const auto& it) { to.cell(it.session.simulated); }},
      {{"first_tick", "tick", "First tick without a sample", kCount},
       [](auto& to, const auto& it) { to.cell(it.gap.first_tick); }},
      {{"last_tick", "tick", "Last tick without a sample; nothing is filled in", kCount},
       [](auto& to, const auto& it) { to.cell(it.gap.last_tick); }},
      {{"missed_ticks", "ticks",
        "Those that never ran, for the loop was held up; others are lost", kCount},
       [](auto& to, const auto& it) { to.cell(it.num_missed); }},
  };
  return kColumns;
}

}  // namespace

const std::vector<CsvColumn>& session_columns() {
  static const std::vector<CsvColumn> kColumns = told(session_table());
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

void write_session(TableWriter& table, const core::SessionRow& session, bool completed,
                   const std::vector<core::EventRow>& events) {
  put(table, session_table(), {session, completed, start_of(events)}).end_row();
}

void write_trial_cells(TableWriter& table, const core::SessionRow& session,
                       const ExportedTrial& trial) {
  put(table, trial_table(), {session, trial}, kNumTrialOwners);
}

void write_trials(TableWriter& table, const core::SessionRow& session,
                  const std::vector<ExportedTrial>& trials) {
  for (const ExportedTrial& trial : trials)
    put(table, trial_table(), {session, trial}).end_row();
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
    std::string given;
    for (const core::AnswerRow& row : answers) {
      if (row.stage == item.stage && row.item == item.name) given = row.answer;
    }
    put(table, questionnaire_table(), {session, item, given}).end_row();
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
