#include "analysis/export/csv_export.h"

#include <string>
#include <vector>

#include "analysis/export/csv_table_writer.h"
#include "core/error.h"
#include "core/hand.h"
#include "core/sample_table.h"
#include "core/storage/recording.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

const std::vector<CsvColumn> kSessionColumns = {
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

const std::vector<CsvColumn> kTrialColumns = {
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

const std::vector<CsvColumn> kPresentationColumns = {
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

const std::vector<CsvColumn> kEventColumns = {
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

const std::vector<CsvColumn> kAnswerColumns = {
    {"session", "", "Number of the session in the study"},
    {"participant", "", "Pseudonym"},
    {"stage", "", "Name of the stage in the study file"},
    {"item", "", "Name of the question or point of a checklist"},
    {"answer", "", "As it was given; the last one if corrected"},
};

std::string unit_of(std::string_view name) {
  if (name == "tick") return "tick";
  if (name.ends_with("_n_m")) return "N m";
  if (name.ends_with("_rad")) return "rad";
  if (name.ends_with("_m_per_s")) return "m/s";
  if (name.ends_with("_m")) return "m";
  if (name.ends_with("_n")) return "N";
  return "";
}

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

class Export {
 public:
  Export(const core::StudyStore& store, fs::path folder, const CsvExportOptions& options)
      : store_(store), folder_(std::move(folder)), options_(options) {
    for (const core::SessionRow& row : store.sessions()) {
      if (!row.pilot || options.pilot) sessions_.push_back(row);
    }
  }

  void run() {
    write_sessions();
    write_trials();
    write_presentations();
    write_events();
    write_answers();
    if (options_.recordings) write_recordings();
    write_codebook();
  }

 private:
  void write_sessions() {
    CsvTableWriter table(folder_ / "sessions.csv", kSessionColumns);
    for (const core::SessionRow& row : sessions_) {
      table.cell(row.session)
          .cell(row.participant)
          .cell(row.cells)
          .cell(std::to_string(row.seed));
      table.cell(std::int64_t{row.pilot}).cell(std::int64_t{row.simulated});
      table.cell(std::int64_t{store_.completed(row.session)})
          .cell(row.device)
          .cell(row.rate_hz);
      table.cell(row.realtime).cell(std::int64_t{row.recorded}).cell(row.program_version);
      table.cell(row.protocol_sha256).cell(row.started_time_ns).end_row();
    }
    table.finish();
  }

  void write_trials() {
    CsvTableWriter table(folder_ / "trials.csv", kTrialColumns);
    for (const core::SessionRow& session : sessions_) {
      std::vector<core::TrialRow> standing = store_.trials(session.session);
      for (const core::TrialRow& row : store_.trials(session.session, true)) {
        bool excluded = true;
        for (const core::TrialRow& other : standing) {
          if (other.sequence == row.sequence) excluded = false;
        }
        table.cell(row.session).cell(session.participant).cell(std::int64_t{session.simulated});
        table.cell(row.trial).cell(row.attempt).cell(row.block).cell(row.procedure);
        table.cell(row.medium).cell(row.quantity).cell(row.repetition).cell(row.position);
        table.cell(row.intensity).cell(row.reference_intensity).cell(row.starting_intensity);
        table.cell(row.target_percent).cell(row.response).cell(row.response_time_s);
        table.cell(row.num_presentations).cell(row.num_steps).cell(row.first_tick);
        table.cell(row.last_tick).cell(std::int64_t{excluded}).end_row();
      }
    }
    table.finish();
  }

  void write_presentations() {
    CsvTableWriter table(folder_ / "presentations.csv", kPresentationColumns);
    for (const core::SessionRow& session : sessions_) {
      for (const core::PresentationRow& row : store_.presentations(session.session)) {
        table.cell(row.session).cell(session.participant).cell(row.trial).cell(row.attempt);
        table.cell(row.presentation)
            .cell(row.interval)
            .cell(row.intensity)
            .cell(row.first_tick);
        table.cell(row.last_tick).cell(row.num_strokes).cell(row.stroke_width_m);
        table.cell(row.max_speed_m_per_s).cell(row.mean_height_m);
        table.cell(row.delivered_damping_n_s_per_m).cell(row.commanded_damping_n_s_per_m);
        table.cell(row.limited_ticks).cell(row.finger_lag_s).end_row();
      }
    }
    table.finish();
  }

  void write_events() {
    CsvTableWriter table(folder_ / "events.csv", kEventColumns);
    for (const core::SessionRow& session : sessions_) {
      for (const core::EventRow& row : store_.events(session.session)) {
        table.cell(row.session).cell(row.sequence).cell(row.kind).cell(row.time_ns);
        table.cell(row.stage).cell(row.trial).cell(row.attempt).cell(row.first_tick);
        table.cell(row.last_tick).cell(row.intensity).cell(row.supersedes).cell(row.data);
        table.end_row();
      }
    }
    table.finish();
  }

  void write_answers() {
    CsvTableWriter table(folder_ / "answers.csv", kAnswerColumns);
    for (const core::SessionRow& session : sessions_) {
      for (const core::AnswerRow& row : store_.answers(session.session)) {
        table.cell(row.session).cell(session.participant).cell(row.stage).cell(row.item);
        table.cell(row.answer).end_row();
      }
    }
    table.finish();
  }

  void write_recordings() {
    fs::create_directories(folder_ / "recordings");
    for (const core::SessionRow& session : sessions_) {
      const fs::path file = store_.recording_file(session.session);
      if (!fs::exists(file)) continue;
      const core::RecordingReader reader(file);
      const bool with_joints = reader.has_joints();
      any_joints_ |= with_joints;
      const std::vector<std::string> names = core::sample_column_names(with_joints);
      std::vector<CsvColumn> columns;
      for (const std::string& name : names) columns.push_back({name.c_str(), "", ""});
      CsvTableWriter table(folder_ / "recordings" / file.stem().concat(".csv"), columns);
      reader.read(0, INT64_MAX, [&](const core::Sample& sample) {
        for (const double value : core::sample_values(sample, with_joints)) table.cell(value);
        table.end_row();
      });
      table.finish();
    }
  }

  void write_codebook() {
    CsvTableWriter table(
        folder_ / "codebook.csv",
        {{"file", "", ""}, {"column", "", ""}, {"unit", "", ""}, {"meaning", "", ""}});
    const std::pair<const char*, const std::vector<CsvColumn>*> kTables[] = {
        {"sessions.csv", &kSessionColumns},
        {"trials.csv", &kTrialColumns},
        {"presentations.csv", &kPresentationColumns},
        {"events.csv", &kEventColumns},
        {"answers.csv", &kAnswerColumns}};
    for (const auto& [file, columns] : kTables) {
      for (const CsvColumn& column : *columns) {
        table.cell(std::string(file)).cell(std::string(column.name));
        table.cell(std::string(column.unit)).cell(std::string(column.meaning)).end_row();
      }
    }
    if (options_.recordings) {
      for (const std::string& name : core::sample_column_names(any_joints_)) {
        table.cell(std::string("recordings/*.csv")).cell(name).cell(unit_of(name));
        table.cell(meaning_of(name)).end_row();
      }
    }
    table.finish();
  }

  const core::StudyStore& store_;
  fs::path folder_;
  CsvExportOptions options_;
  std::vector<core::SessionRow> sessions_;
  bool any_joints_ = false;  ///< In any of the recordings.
};

}  // namespace

void export_csv(const core::StudyStore& store, const fs::path& folder,
                const CsvExportOptions& options) {
  std::error_code error;
  if (fs::exists(folder) && !fs::is_empty(folder, error)) {
    throw core::Error(
        folder.string() +
        ": expected a new or empty folder, found files in it; nothing is overwritten");
  }
  fs::create_directories(folder, error);
  if (error) {
    throw core::Error(folder.string() +
                      ": expected to make this folder, found: " + error.message());
  }
  Export(store, folder, options).run();
}

}  // namespace jnd::analysis
