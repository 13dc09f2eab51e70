#include "analysis/export/study_tables.h"

#include <algorithm>

#include "core/sample_table.h"

namespace jnd::analysis {

const std::vector<CsvColumn>& session_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study"},
      {"participant", "", "Pseudonym"},
      {"cells", "", "Counterbalancing: which arms in which order"},
      {"seed", "", "Of everything drawn in the session"},
      {"pilot", "", "1: a pilot, not for analysis"},
      {"simulated", "", "1: SIMULATED participant and apparatus"},
      {"completed", "", "1: every stage was run"},
      {"device", "", "Name of the device"},
      {"rate_hz", "Hz", "Rate of the haptic loop and of the recording"},
      {"realtime", "", "What the loop was given by the system"},
      {"recorded", "", "1: samples are kept"},
      {"program_version", "", "Of jnd"},
      {"protocol_sha256", "", "Identifies the study file"},
      {"started_time_ns", "ns", "Since 1970-01-01 UTC; a simulated session counts from 0"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& participant_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus"},
      {"num_sessions", "", "Visits in this data set"},
      {"num_completed_sessions", "", "Of them, those in which every stage was run"},
      {"num_trials", "", "Trials whose answer stands, those set aside among them"},
      {"num_excluded_trials", "", "Of them, those set aside with a reason"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& trial_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study"},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus"},
      {"trial", "", "Running number in the session, from 1"},
      {"attempt", "", "1, or more if the trial was repeated"},
      {"block", "", "Name of the block in the study file"},
      {"procedure", "", "How the block asks"},
      {"medium", "", "What was rendered"},
      {"quantity", "", "What intensities mean: scale (ratio) or viscosity_pa_s (Pa s)"},
      {"repetition", "", "From 1; in each, every stimulus once"},
      {"position", "", "Within the repetition, from 1"},
      {"intensity", "unit of quantity", "Test stimulus; in production, the value set"},
      {"reference_intensity", "unit of quantity", "Reference stimulus"},
      {"starting_intensity", "unit of quantity", "Production: where the adjustment began"},
      {"target_percent", "%", "Production: what it should feel like, water being 100"},
      {"response", "", "Percent; 1 yes, 0 no; in production the value set"},
      {"response_time_s", "s", "From the start of the last stimulus to the answer"},
      {"num_presentations", "", "Stimuli felt in this attempt"},
      {"num_steps", "", "Production: steps of adjustment"},
      {"first_tick", "tick", "First sample of the trial in the recording"},
      {"last_tick", "tick", "Last sample of the trial in the recording"},
      {"excluded", "", "1: set aside with a reason, see events.csv"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& presentation_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study"},
      {"participant", "", "Pseudonym"},
      {"trial", "", "Running number in the session"},
      {"attempt", "", "Attempt whose answer stands"},
      {"presentation", "", "Within the attempt, from 1"},
      {"interval", "", "test, reference or free_space"},
      {"intensity", "unit of quantity", "What was presented"},
      {"first_tick", "tick", "First sample in the recording"},
      {"last_tick", "tick", "Last sample in the recording"},
      {"num_strokes", "", "Whole strokes: to a turning point and back"},
      {"stroke_width_m", "m", "Mean distance between turning points"},
      {"max_speed_m_per_s", "m/s", "Mean of the highest speed in each stroke"},
      {"mean_height_m", "m", "Mean height of the hand, workspace frame"},
      {"delivered_damping_n_s_per_m", "N s/m", "Delivered force over speed, regression slope"},
      {"commanded_damping_n_s_per_m", "N s/m", "Commanded; empty for water"},
      {"limited_ticks", "ticks", "Ticks in which the force limiter changed the force"},
      {"finger_lag_s", "s", "By which thumb, index and middle trail behind the palm"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& event_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study"},
      {"sequence", "", "1, 2, 3 ... in the order in which it happened"},
      {"kind", "", "What happened"},
      {"time_ns", "ns", "Since 1970-01-01 UTC; a simulated session counts from 0"},
      {"stage", "", "Place of the stage in the participant's list, from 0"},
      {"trial", "", "Running number in the session"},
      {"attempt", "", "1 is the first"},
      {"first_tick", "tick", "In the recording"},
      {"last_tick", "tick", "In the recording"},
      {"intensity", "unit of quantity", "Presented or set"},
      {"supersedes", "", "Sequence of the event that no longer counts"},
      {"data", "", "Everything else, as JSON"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& answer_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study"},
      {"participant", "", "Pseudonym"},
      {"stage", "", "Name of the stage in the study file"},
      {"item", "", "Name of the question or point of a checklist"},
      {"answer", "", "As it was given; the last one if corrected"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& questionnaire_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study"},
      {"participant", "", "Pseudonym"},
      {"stage", "", "Name of the questionnaire in the study file"},
      {"item", "", "Name of the question in the study file"},
      {"kind", "",
       "How it is answered: number, text, choice, yes_no, yes_no_which, scale, words"},
      {"question", "", "As it was asked, in English where the study has it"},
      {"unit", "", "Of a number"},
      {"num_steps", "", "Of a scale, which begins at 1"},
      {"answer", "", "As it was given, the last one if corrected; empty: none"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& gap_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study"},
      {"first_tick", "tick", "First sample that was lost"},
      {"last_tick", "tick", "Last sample that was lost; nothing is filled in"},
  };
  return kColumns;
}

std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                           std::int64_t session) {
  std::vector<std::int64_t> standing;
  for (const core::TrialRow& row : store.trials(session)) standing.push_back(row.sequence);
  std::sort(standing.begin(), standing.end());
  std::vector<ExportedTrial> trials;
  for (core::TrialRow& row : store.trials(session, true)) {
    const bool stands = std::binary_search(standing.begin(), standing.end(), row.sequence);
    trials.push_back({.row = std::move(row), .excluded = !stands});
  }
  return trials;
}

void write_trial(CsvTableWriter& table, const ExportedTrial& trial) {
  const core::TrialRow& row = trial.row;
  table.cell(row.trial).cell(row.attempt).cell(row.block).cell(row.procedure);
  table.cell(row.medium).cell(row.quantity).cell(row.repetition).cell(row.position);
  table.cell(row.intensity).cell(row.reference_intensity).cell(row.starting_intensity);
  table.cell(row.target_percent).cell(row.response).cell(row.response_time_s);
  table.cell(row.num_presentations).cell(row.num_steps).cell(row.first_tick);
  table.cell(row.last_tick).cell(std::int64_t{trial.excluded});
}

void write_presentation(CsvTableWriter& table, const core::PresentationRow& row) {
  table.cell(row.trial).cell(row.attempt).cell(row.presentation).cell(row.interval);
  table.cell(row.intensity).cell(row.first_tick).cell(row.last_tick).cell(row.num_strokes);
  table.cell(row.stroke_width_m).cell(row.max_speed_m_per_s).cell(row.mean_height_m);
  table.cell(row.delivered_damping_n_s_per_m).cell(row.commanded_damping_n_s_per_m);
  table.cell(row.limited_ticks).cell(row.finger_lag_s);
}

namespace {

std::string meaning_of(std::string_view name) {
  if (name == "tick") return "Counted from 0 in the session";
  if (name == "attached_bits") return "Bit i: point i holds the hand";
  if (name == "immersed_bits") return "Bit i: point i is in the medium";
  if (name == "limited") return "1: the force limiter changed the force";
  if (name == "fault") return "0: none";
  if (name.ends_with("_rad")) return "Only from a device with joints; by its encoder";
  if (name.ends_with("_n_m")) return "Only from a device with joints; by its torque sensor";
  if (name.starts_with("end_effector")) {
    return "Of the arm that carries the fingers; workspace frame: x right, y away, z up";
  }
  return "Workspace frame: x right, y away, z up; force on the hand after every limit";
}

struct Unit {
  const char* ending;
  const char* unit;
  int decimals;
};

/// The decimals are those of the units in core/storage/sample_codec.h. "_n_m" stands before
/// "_m", for the first that fits counts.
constexpr Unit kUnits[] = {{"_n_m", "N m", 4}, {"_rad", "rad", 6}, {"_m_per_s", "m/s", 4},
                           {"_m", "m", 7},     {"_n", "N", 3},     {"tick", "tick", 0}};

}  // namespace

std::vector<RecordingColumn> recording_columns(bool with_joints) {
  std::vector<RecordingColumn> columns;
  for (std::string& name : core::sample_column_names(with_joints)) {
    RecordingColumn column{.name = std::move(name)};
    column.meaning = meaning_of(column.name);
    for (const Unit& unit : kUnits) {
      if (!column.name.ends_with(unit.ending)) continue;
      column.unit = unit.unit;
      column.decimals = unit.decimals;
      break;
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

std::optional<RecordingGap> GapFinder::tell(std::int64_t tick) {
  std::optional<RecordingGap> gap;
  if (previous_ && tick > *previous_ + 1) gap = {*previous_ + 1, tick - 1};
  if (!previous_ || tick > *previous_) previous_ = tick;
  return gap;
}

}  // namespace jnd::analysis
