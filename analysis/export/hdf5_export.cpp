#include "analysis/export/hdf5_export.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "analysis/export/hdf5_file.h"
#include "analysis/export/study_tables.h"
#include "analysis/export/unfinished_folder.h"
#include "core/error.h"
#include "core/sample_table.h"
#include "core/storage/recording.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

std::string group_name(std::int64_t session) {
  char name[32];
  std::snprintf(name, sizeof name, "session_%04lld", static_cast<long long>(session));
  return name;
}

const CsvColumn& column_of(const std::vector<CsvColumn>& columns, const std::string& name) {
  for (const CsvColumn& column : columns) {
    if (name == column.name) return column;
  }
  throw core::Error("codebook: expected a column " + name + ", found none");
}

/// A table of rows as a group of columns, told of as the codebook does.
template <typename Row>
class ColumnWriter {
 public:
  ColumnWriter(const Hdf5Group& group, const std::vector<CsvColumn>& columns,
               const std::vector<Row>& rows)
      : group_(group), columns_(columns), rows_(rows) {}

  void numbers(const char* name, Hdf5Number type,
               const std::function<double(const Row&)>& value) const {
    const CsvColumn& column = column_of(columns_, name);
    std::vector<double> all;
    for (const Row& row : rows_) all.push_back(value(row));
    group_.column(name, type, column.unit, column.meaning).append(all);
  }
  void texts(const char* name, const std::function<std::string(const Row&)>& value) const {
    std::vector<std::string> all;
    for (const Row& row : rows_) all.push_back(value(row));
    group_.texts(name, all, column_of(columns_, name).meaning);
  }

 private:
  const Hdf5Group& group_;
  const std::vector<CsvColumn>& columns_;
  const std::vector<Row>& rows_;
};

constexpr Hdf5Number kCount = Hdf5Number::kInt64;
constexpr Hdf5Number kReal = Hdf5Number::kDouble;

double count(std::int64_t number) { return static_cast<double>(number); }
double real(const std::optional<double>& number) { return number.value_or(NAN); }

void write_trials(const Hdf5Group& group, const std::vector<ExportedTrial>& trials) {
  using T = ExportedTrial;
  const ColumnWriter<T> write(group, trial_columns(), trials);
  write.numbers("trial", kCount, [](const T& t) { return count(t.row.trial); });
  write.numbers("attempt", kCount, [](const T& t) { return count(t.row.attempt); });
  write.texts("block", [](const T& t) { return t.row.block; });
  write.texts("procedure", [](const T& t) { return t.row.procedure; });
  write.texts("medium", [](const T& t) { return t.row.medium; });
  write.texts("quantity", [](const T& t) { return t.row.quantity; });
  write.numbers("repetition", kCount, [](const T& t) { return count(t.row.repetition); });
  write.numbers("position", kCount, [](const T& t) { return count(t.row.position); });
  write.numbers("intensity", kReal, [](const T& t) { return real(t.row.intensity); });
  write.numbers("reference_intensity", kReal,
                [](const T& t) { return real(t.row.reference_intensity); });
  write.numbers("starting_intensity", kReal,
                [](const T& t) { return real(t.row.starting_intensity); });
  write.numbers("target_percent", kReal, [](const T& t) { return real(t.row.target_percent); });
  write.numbers("response", kReal, [](const T& t) { return real(t.row.response); });
  write.numbers("response_time_s", kReal,
                [](const T& t) { return real(t.row.response_time_s); });
  write.numbers("num_presentations", kCount,
                [](const T& t) { return count(t.row.num_presentations); });
  write.numbers("num_steps", kCount, [](const T& t) { return count(t.row.num_steps); });
  write.numbers("first_tick", kCount, [](const T& t) { return count(t.row.first_tick); });
  write.numbers("last_tick", kCount, [](const T& t) { return count(t.row.last_tick); });
  write.numbers("excluded", Hdf5Number::kUint8, [](const T& t) { return count(t.excluded); });
}

void write_presentations(const Hdf5Group& group,
                         const std::vector<core::PresentationRow>& rows) {
  using P = core::PresentationRow;
  const ColumnWriter<P> write(group, presentation_columns(), rows);
  write.numbers("trial", kCount, [](const P& p) { return count(p.trial); });
  write.numbers("attempt", kCount, [](const P& p) { return count(p.attempt); });
  write.numbers("presentation", kCount, [](const P& p) { return count(p.presentation); });
  write.texts("interval", [](const P& p) { return p.interval; });
  write.numbers("intensity", kReal, [](const P& p) { return p.intensity; });
  write.numbers("first_tick", kCount, [](const P& p) { return count(p.first_tick); });
  write.numbers("last_tick", kCount, [](const P& p) { return count(p.last_tick); });
  write.numbers("num_strokes", kCount, [](const P& p) { return count(p.num_strokes); });
  write.numbers("stroke_width_m", kReal, [](const P& p) { return real(p.stroke_width_m); });
  write.numbers("max_speed_m_per_s", kReal,
                [](const P& p) { return real(p.max_speed_m_per_s); });
  write.numbers("mean_height_m", kReal, [](const P& p) { return real(p.mean_height_m); });
  write.numbers("delivered_damping_n_s_per_m", kReal,
                [](const P& p) { return real(p.delivered_damping_n_s_per_m); });
  write.numbers("commanded_damping_n_s_per_m", kReal,
                [](const P& p) { return real(p.commanded_damping_n_s_per_m); });
  write.numbers("limited_ticks", kCount, [](const P& p) { return count(p.limited_ticks); });
  write.numbers("finger_lag_s", kReal, [](const P& p) { return real(p.finger_lag_s); });
}

Hdf5Number type_of(const RecordingColumn& column) {
  if (column.name == "tick") return Hdf5Number::kInt64;
  return column.unit.empty() ? Hdf5Number::kUint8 : Hdf5Number::kDouble;
}

/// A number that was stored in steps of 10^-decimals, as the double nearest to it: the one that
/// reading the same cell of the CSV gives.
double on_grid(double number, int decimals) {
  static constexpr double kSteps[] = {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7};
  const double multiple = number * kSteps[decimals];
  const double whole = std::round(multiple);
  const bool fits = std::abs(multiple) < 1e15 && std::abs(multiple - whole) <= 1e-3;
  return fits ? whole / kSteps[decimals] : number;
}

/// Returns the gaps that were found.
std::vector<RecordingGap> write_samples(const Hdf5Group& group,
                                        const core::RecordingReader& reader) {
  const bool with_joints = reader.has_joints();
  const std::vector<RecordingColumn> columns = recording_columns(with_joints);
  std::vector<Hdf5Column> datasets;
  std::vector<std::vector<double>> buffers(columns.size());
  for (const RecordingColumn& column : columns) {
    datasets.push_back(group.column(column.name, type_of(column), column.unit, column.meaning));
  }
  const auto flush = [&] {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      datasets[i].append(buffers[i]);
      buffers[i].clear();
    }
  };
  GapFinder finder;
  std::vector<RecordingGap> gaps;
  reader.read(0, INT64_MAX, [&](const core::Sample& sample) {
    if (const auto gap = finder.tell(sample.tick)) gaps.push_back(*gap);
    const std::vector<double> values = core::sample_values(sample, with_joints);
    for (std::size_t i = 0; i < values.size(); ++i) {
      buffers[i].push_back(on_grid(values[i], columns[i].decimals));
    }
    if (buffers.front().size() == Hdf5Column::kChunkRows) flush();
  });
  flush();
  return gaps;
}

void write_gaps(const Hdf5Group& group, const std::vector<RecordingGap>& gaps) {
  const ColumnWriter<RecordingGap> write(group, gap_columns(), gaps);
  write.numbers("first_tick", kCount,
                [](const RecordingGap& g) { return count(g.first_tick); });
  write.numbers("last_tick", kCount, [](const RecordingGap& g) { return count(g.last_tick); });
}

void write_session(const Hdf5Group& root, const core::StudyStore& store,
                   const core::SessionRow& row) {
  const Hdf5Group group = root.group(group_name(row.session));
  group.attribute("participant", row.participant);
  group.attribute("cells", row.cells);
  group.attribute("seed", std::to_string(row.seed));
  group.attribute("pilot", std::int64_t{row.pilot});
  group.attribute("simulated", std::int64_t{row.simulated});
  group.attribute("completed", std::int64_t{store.completed(row.session)});
  group.attribute("device", row.device);
  group.attribute("rate_hz", row.rate_hz);
  group.attribute("realtime", row.realtime);
  group.attribute("program_version", row.program_version);
  group.attribute("protocol_sha256", row.protocol_sha256);
  group.attribute("started_time_ns", row.started_time_ns);
  write_trials(group.group("trials"), exported_trials(store, row.session));
  write_presentations(group.group("presentations"), store.presentations(row.session));
  const fs::path file = store.recording_file(row.session);
  const bool recorded = fs::exists(file);
  group.attribute("recorded", std::int64_t{recorded});
  if (!recorded) return;
  const std::vector<RecordingGap> gaps = write_samples(group, core::RecordingReader(file));
  write_gaps(group.group("gaps"), gaps);
  std::int64_t missing = 0;
  for (const RecordingGap& gap : gaps) missing += gap.last_tick - gap.first_tick + 1;
  group.attribute("missing_ticks", missing);
}

}  // namespace

void export_hdf5(const core::StudyStore& store, const fs::path& folder,
                 const ExportOptions& options) {
  const std::vector<core::SessionRow> sessions = exported_sessions(store, options);
  UnfinishedFolder unfinished(folder);
  Hdf5File file(unfinished.path() / "study.h5");
  bool simulated = false;
  for (const core::SessionRow& row : sessions) simulated |= row.simulated;
  file.root().attribute("content",
                        simulated ? "SIMULATED participants and apparatus: recordings of jnd"
                                  : "recordings of jnd");
  file.root().attribute("simulated", std::int64_t{simulated});
  file.root().attribute("frame",
                        "workspace: x right, y away, z up; forces are those on the hand");
  file.root().attribute("missing_values", "NaN");
  for (const core::SessionRow& row : sessions) write_session(file.root(), store, row);
  file.finish();
  unfinished.publish();
}

}  // namespace jnd::analysis
