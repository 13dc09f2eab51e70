#include "analysis/export/hdf5_export.h"

#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/export/exported_profiles.h"
#include "analysis/export/exported_recording.h"
#include "analysis/export/hdf5_file.h"
#include "analysis/export/hdf5_table_writer.h"
#include "analysis/export/recording_columns.h"
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

Hdf5Number hdf5_type_of(const RecordingColumn& column) {
  if (column.name == "tick" || column.name == "buttons") return Hdf5Number::kInt64;
  return column.unit.empty() ? Hdf5Number::kUint8 : Hdf5Number::kDouble;
}

void write_samples(const Hdf5Group& group, const ExportedRecording& recording) {
  const core::SampleColumns which = recording.columns();
  const std::vector<RecordingColumn> columns = recording_columns(which);
  std::vector<Hdf5Column> datasets;
  std::vector<std::vector<double>> buffers(columns.size());
  for (const RecordingColumn& column : columns) {
    datasets.push_back(
        group.column(column.name, hdf5_type_of(column), column.unit, column.meaning));
  }
  const auto flush = [&] {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      datasets[i].append(buffers[i]);
      buffers[i].clear();
    }
  };
  recording.read(0, INT64_MAX, [&](const core::Sample& sample) {
    const std::vector<double> values = core::sample_values(sample, which);
    for (std::size_t i = 0; i < values.size(); ++i) {
      buffers[i].push_back(on_grid(values[i], columns[i]));
    }
    if (buffers.front().size() == Hdf5Column::kChunkRows) flush();
  });
  flush();
}

class Hdf5Export {
 public:
  Hdf5Export(const core::StudyStore& store, const ExportOptions& options, const Hdf5Group& root)
      : store_(store),
        options_(options),
        root_(root),
        sessions_(exported_sessions(store, options)) {}

  ExportOutcome run() {
    describe();
    write_table(root_, "sessions", session_columns(), [this](TableWriter& table) {
      for (const core::SessionRow& session : sessions_) {
        write_session(table, session, store_.completed(session.session),
                      store_.events(session.session));
      }
    });
    std::size_t num_done = 0;
    for (const core::SessionRow& session : sessions_) {
      if (options_.keep_going) options_.keep_going();
      core::tell(options_.on_progress, num_done++, sessions_.size());
      write_one(root_.group(group_name(session.session)), session);
    }
    write_device_profiles();
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
    const std::vector<ExportedTrial> trials = exported_trials(store_, session.session);
    const std::vector<core::AnswerRow> answers = store_.answers(session.session);
    const ExportedRecording recording(store_, session, options_);
    write_table(group, "trials", trial_columns(),
                [&](TableWriter& table) { write_trials(table, session, trials); });
    write_table(group, "presentations", presentation_columns(), [&](TableWriter& table) {
      write_presentations(table, session,
                          exported_presentations(store_, session.session, trials));
    });
    write_table(group, "events", event_columns(), [&](TableWriter& table) {
      write_events(table, session, store_.events(session.session));
    });
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
    any_columns_ = any_columns_ | recording.columns();
    outcome_.samples = true;
    write_samples(group, recording);
  }

  void write_codebook_table() const {
    write_table(root_, "codebook", codebook_columns(), [this](TableWriter& table) {
      write_codebook(table, {{"sessions", &session_columns()},
                             {"session_*/trials", &trial_columns()},
                             {"session_*/presentations", &presentation_columns()},
                             {"session_*/events", &event_columns()},
                             {"session_*/answers", &answer_columns()},
                             {"session_*/questionnaires", &questionnaire_columns()},
                             {"session_*/questions", &question_columns()},
                             {"session_*/gaps", &gap_columns()},
                             {"codebook", &codebook_columns()}});
      for (const RecordingColumn& column : recording_columns(any_columns_)) {
        table.cell("session_*").cell(column.name).cell(column.unit);
        table.cell(column.meaning).end_row();
      }
    });
  }

  const core::StudyStore& store_;
  const ExportOptions& options_;
  const Hdf5Group& root_;
  std::vector<core::SessionRow> sessions_;
  StudyQuestions questions_{store_};
  core::SampleColumns any_columns_;
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
