#include "analysis/export/hdf5_export.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/export/exported_profiles.h"
#include "analysis/export/exported_recording.h"
#include "analysis/export/hdf5_file.h"
#include "analysis/export/hdf5_table_writer.h"
#include "analysis/export/recording_columns.h"
#include "analysis/export/recording_rows.h"
#include "analysis/export/study_tables.h"
#include "analysis/export/table_rows.h"
#include "analysis/export/unfinished_folder.h"
#include "core/sample_table.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

std::string group_name(std::int64_t session) {
  char name[32];
  std::snprintf(name, sizeof name, "session_%04lld", static_cast<long long>(session));
  return name;
}

/// The type of a column that is stored unchanged: ticks, times and flags. All others are stored
/// as steps.
std::optional<Hdf5Number> plain_type_of(const RecordingColumn& column) {
  if (column.name() == "tick" || column.name() == "buttons") return Hdf5Number::kInt64;
  if (column.is_flags) return Hdf5Number::kUint8;
  // A time in steps of a microsecond would need more than 32 bits after an hour.
  return column.unit == "s" ? std::optional(Hdf5Number::kDouble) : std::nullopt;
}

/// Columns that form one array.
struct ArrayOfColumns {
  Hdf5ArrayOptions options;
  std::vector<std::size_t> columns;  ///< The indices of its columns, in the order of the parts.
};

void add_part(std::vector<std::string>& parts, const std::string& part) {
  if (std::ranges::find(parts, part) == parts.end()) parts.push_back(part);
}

std::vector<ArrayOfColumns> arrays_of(const std::vector<RecordingColumn>& columns) {
  std::vector<ArrayOfColumns> arrays;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const RecordingColumn& column = columns[i];
    if (plain_type_of(column)) continue;
    auto its = std::ranges::find(arrays, column.column.array,
                                 [](const ArrayOfColumns& one) { return one.options.name; });
    if (its == arrays.end()) {
      arrays.push_back({.options = {.name = column.column.array,
                                    .unit = column.unit,
                                    .meaning = column.meaning,
                                    .step = column.step()}});
      its = std::prev(arrays.end());
      if (!column.column.part.empty()) {
        its->options.dimensions.emplace_back(
            column.unit == "rad" || column.unit == "N m" ? "joint" : "point");
      }
      if (!column.column.component.empty()) {
        its->options.dimensions.emplace_back(column.unit == "1" ? "component" : "axis");
      }
      its->options.parts.resize(its->options.dimensions.size());
    }
    its->columns.push_back(i);
    if (!column.column.part.empty()) add_part(its->options.parts.front(), column.column.part);
    if (!column.column.component.empty()) {
      add_part(its->options.parts.back(), column.column.component);
    }
  }
  return arrays;
}

void write_samples(const Hdf5Group& group, const RecordingRows& rows) {
  const std::vector<RecordingColumn>& columns = rows.columns();
  std::vector<std::size_t> plain;
  std::vector<Hdf5Column> datasets;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::optional<Hdf5Number> type = plain_type_of(columns[i]);
    if (!type) continue;
    plain.push_back(i);
    datasets.push_back(
        group.column(columns[i].name(), *type, columns[i].unit, columns[i].meaning));
  }
  const std::vector<ArrayOfColumns> sets = arrays_of(columns);
  std::vector<Hdf5Array> arrays;
  for (const ArrayOfColumns& one : sets) arrays.push_back(group.array(one.options));
  std::vector<std::vector<double>> buffers(plain.size());
  const auto flush = [&] {
    for (std::size_t i = 0; i < plain.size(); ++i) {
      datasets[i].append(buffers[i]);
      buffers[i].clear();
    }
  };
  std::vector<double> moment;
  rows.read([&](const std::vector<double>& values) {
    for (std::size_t i = 0; i < plain.size(); ++i) {
      buffers[i].push_back(on_grid(values[plain[i]], columns[plain[i]]));
    }
    for (std::size_t i = 0; i < sets.size(); ++i) {
      moment.clear();
      for (const std::size_t column : sets[i].columns) moment.push_back(values[column]);
      arrays[i].append(moment.data());
    }
    if (buffers.front().size() == Hdf5Column::kChunkRows) flush();
  });
  flush();
  for (Hdf5Array& array : arrays) array.finish();
}

class Hdf5Export {
 public:
  Hdf5Export(const core::StudyStore& store, const ExportOptions& options, const Hdf5Group& root)
      : store_(store),
        options_(options),
        root_(root),
        sessions_(exported_sessions(store, options)),
        factors_(store, sessions_, trial_columns()) {}

  ExportOutcome run() {
    describe();
    write_table(root_, "sessions", session_columns(), [this](TableWriter& table) {
      for (const core::SessionRow& session : sessions_) {
        write_session(table, session, store_.completed(session.session),
                      store_.events(session.session));
      }
    });
    write_table(root_, "session_values", session_value_columns(), [this](TableWriter& table) {
      for (const core::SessionRow& session : sessions_) {
        write_session_values(table, session, store_.events(session.session));
      }
    });
    std::size_t num_done = 0;
    for (const core::SessionRow& session : sessions_) {
      if (options_.keep_going) options_.keep_going();
      core::tell(options_.on_progress, num_done++, sessions_.size());
      write_one(root_.group(group_name(session.session)), session);
    }
    write_device_profiles();
    write_laboratories();
    if (!options_.preregistration.registered_on.empty()) {
      write_table(root_, "deviations", deviation_columns(), [this](TableWriter& table) {
        write_deviations(table, options_.preregistration);
      });
    }
    write_codebook_table();
    root_.texts("problems", outcome_.problems, "What recordings have lost; empty: nothing");
    return std::move(outcome_);
  }

 private:
  void describe() const {
    bool simulated = false;
    for (const core::SessionRow& row : sessions_) simulated |= row.simulated;
    root_.attribute("content", simulated
                                   ? "SIMULATED participants and apparatus: recordings of jnd"
                                   : "recordings of jnd");
    root_.attribute("simulated", std::int64_t{simulated});
    root_.attribute("frame", "workspace: x right, y away, z up; forces are those on the hand");
    root_.attribute("missing_values", "NaN");
  }

  void write_device_profiles() const {
    const std::vector<core::DeviceProfileRow> profiles = exported_profiles(store_, sessions_);
    if (profiles.empty()) return;
    std::vector<std::string> hashes, texts;
    for (const core::DeviceProfileRow& profile : profiles) {
      hashes.push_back(profile.sha256);
      texts.push_back(profile.text);
    }
    const Hdf5Group group = root_.group("device_profiles");
    group.texts("sha256", hashes, "As in device_profile_sha256 of a session");
    group.texts("text", texts, "What was measured of the device, as JSON");
  }

  void write_laboratories() const {
    const std::vector<ExportedLaboratory> laboratories = exported_laboratories(sessions_);
    if (laboratories.empty()) return;
    std::vector<std::string> hashes, texts;
    for (const ExportedLaboratory& one : laboratories) {
      hashes.push_back(one.sha256);
      texts.push_back(one.text);
    }
    const Hdf5Group group = root_.group("laboratories");
    group.texts("sha256", hashes, "As in laboratory_sha256 of a session");
    group.texts("text", texts, "Who was simulated, as JSON");
  }

  static void write_table(const Hdf5Group& group, const std::string& name,
                          const std::vector<CsvColumn>& columns,
                          const std::function<void(TableWriter&)>& fill) {
    Hdf5TableWriter table(columns);
    fill(table);
    table.write(group.group(name));
  }

  void describe_session(const Hdf5Group& group, const core::SessionRow& row) const {
    group.attribute("participant", row.participant);
    group.attribute("cells", row.cells);
    group.attribute("seed", std::to_string(row.seed));
    group.attribute("pilot", std::int64_t{row.pilot});
    group.attribute("simulated", std::int64_t{row.simulated});
    group.attribute("completed", std::int64_t{store_.completed(row.session)});
    group.attribute("device", row.device);
    group.attribute("device_profile_sha256", row.device_profile_sha256);
    group.attribute("rate_hz", row.rate_hz);
    group.attribute("realtime", row.realtime);
    group.attribute("program_version", row.program_version);
    group.attribute("protocol_sha256", row.protocol_sha256);
    group.attribute("started_time_ns", row.started_time_ns);
  }

  void write_one(const Hdf5Group& group, const core::SessionRow& session) {
    describe_session(group, session);
    const std::vector<ExportedTrial> trials =
        exported_trials(store_, session.session, options_.selection);
    const std::vector<ExportedPresentation> presentations =
        exported_presentations(store_, session.session, trials);
    const std::vector<core::AnswerRow> answers = store_.answers(session.session);
    const ExportedRecording recording(store_, session, options_);
    write_table(group, "trials", factors_.columns(),
                [&](TableWriter& table) { write_trials(table, session, trials, factors_); });
    write_table(group, "presentations", presentation_columns(), [&](TableWriter& table) {
      write_presentations(table, session, presentations);
    });
    const std::vector<core::EventRow> events = store_.events(session.session);
    write_table(group, "events", event_columns(),
                [&](TableWriter& table) { write_events(table, session, events); });
    write_table(group, "markers", marker_columns(),
                [&](TableWriter& table) { write_markers(table, session, events); });
    write_table(group, "answers", answer_columns(),
                [&](TableWriter& table) { write_answers(table, session, answers); });
    write_table(group, "questionnaires", questionnaire_columns(), [&](TableWriter& table) {
      write_questionnaire(table, session, answers, questions_.of(session));
    });
    write_table(group, "questions", question_columns(), [&](TableWriter& table) {
      write_questions(table, session,
                      exported_question_answers(store_, session.session, trials));
    });
    write_table(group, "gaps", gap_columns(),
                [&](TableWriter& table) { write_gaps(table, session, recording); });
    group.attribute("recorded", std::int64_t{recording.any()});
    group.attribute("missing_ticks", core::num_ticks(recording.gaps()));
    if (!recording.problem().empty()) outcome_.problems.push_back(recording.problem());
    if (!recording.any()) return;
    const RecordingRows rows(recording, session, options_.selection,
                             ticks_of_blocks(trials, presentations, options_.selection));
    for (const RecordingColumn& column : rows.columns()) tell(column);
    outcome_.samples = true;
    group.attribute("samples_rate_hz", rows.rate_hz());
    group.attribute("ticks_per_sample", rows.ticks_per_row());
    write_samples(group, rows);
  }

  /// Collects each dataset once for the codebook.
  void tell(const RecordingColumn& column) {
    const std::string& dataset = plain_type_of(column) ? column.name() : column.column.array;
    if (std::ranges::find(told_, dataset, &RecordingColumn::name) != told_.end()) return;
    told_.push_back(column);
    told_.back().column.name = dataset;
  }

  void write_codebook_table() const {
    write_table(root_, "codebook", codebook_columns(), [this](TableWriter& table) {
      write_codebook(table, {{"sessions", &session_columns()},
                             {"session_values", &session_value_columns()},
                             {"session_*/trials", &factors_.columns()},
                             {"session_*/presentations", &presentation_columns()},
                             {"session_*/events", &event_columns()},
                             {"session_*/markers", &marker_columns()},
                             {"session_*/answers", &answer_columns()},
                             {"session_*/questionnaires", &questionnaire_columns()},
                             {"session_*/questions", &question_columns()},
                             {"session_*/gaps", &gap_columns()},
                             {"codebook", &codebook_columns()}});
      if (!options_.preregistration.registered_on.empty()) {
        write_codebook(table, {{"deviations", &deviation_columns()}});
      }
      for (const RecordingColumn& column : told_) {
        table.cell("session_*").cell(column.name()).cell(column.unit);
        table.cell(column.meaning).end_row();
      }
    });
  }

  const core::StudyStore& store_;
  const ExportOptions& options_;
  const Hdf5Group& root_;
  std::vector<core::SessionRow> sessions_;
  FactorColumns factors_;
  StudyQuestions questions_{store_};
  std::vector<RecordingColumn> told_;  ///< The datasets of samples in any session.
  ExportOutcome outcome_;
};

}  // namespace

ExportOutcome export_hdf5(const core::StudyStore& store, const fs::path& folder,
                          const ExportOptions& options) {
  ExportOutcome outcome;
  write_folder(folder, [&](const UnfinishedFolder& unfinished) {
    Hdf5File file(unfinished.path() / "study.h5");
    outcome = Hdf5Export(store, options, file.root()).run();
    file.finish();
  });
  return outcome;
}

}  // namespace jnd::analysis
