#include "analysis/export/csv_export.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/export/study_tables.h"
#include "analysis/export/unfinished_folder.h"
#include "analysis/questionnaire_items.h"
#include "core/sample_table.h"
#include "core/storage/recording.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

class Export {
 public:
  Export(const core::StudyStore& store, const UnfinishedFolder& folder,
         const ExportOptions& options)
      : store_(store),
        folder_(folder),
        options_(options),
        sessions_(exported_sessions(store, options)) {}

  void run() {
    write_sessions();
    write_participants();
    write_trials();
    write_presentations();
    write_events();
    write_answers();
    write_questionnaires();
    if (options_.recordings) write_recordings();
    write_codebook();
  }

 private:
  void write_sessions() {
    CsvTableWriter table(folder_.path() / "sessions.csv", session_columns());
    for (const core::SessionRow& row : sessions_) {
      table.cell(row.session).cell(row.participant).cell(row.cells);
      table.cell(std::to_string(row.seed)).cell(std::int64_t{row.pilot});
      table.cell(std::int64_t{row.simulated});
      table.cell(std::int64_t{store_.completed(row.session)}).cell(row.device);
      table.cell(row.rate_hz).cell(row.realtime).cell(std::int64_t{row.recorded});
      table.cell(row.program_version).cell(row.protocol_sha256).cell(row.started_time_ns);
      table.end_row();
    }
    table.finish();
  }

  void write_participants() {
    struct Count {
      bool simulated = false;
      std::int64_t sessions = 0, completed = 0, trials = 0, excluded = 0;
    };
    std::map<std::string, Count> counts;
    for (const core::SessionRow& session : sessions_) {
      Count& count = counts[session.participant];
      count.simulated |= session.simulated;
      ++count.sessions;
      count.completed += std::int64_t{store_.completed(session.session)};
      for (const ExportedTrial& trial : exported_trials(store_, session.session)) {
        ++count.trials;
        count.excluded += std::int64_t{trial.excluded};
      }
    }
    CsvTableWriter table(folder_.path() / "participants.csv", participant_columns());
    for (const auto& [participant, count] : counts) {
      table.cell(participant).cell(std::int64_t{count.simulated}).cell(count.sessions);
      table.cell(count.completed).cell(count.trials).cell(count.excluded).end_row();
    }
    table.finish();
  }

  void write_trials() {
    CsvTableWriter table(folder_.path() / "trials.csv", trial_columns());
    for (const core::SessionRow& session : sessions_) {
      for (const ExportedTrial& trial : exported_trials(store_, session.session)) {
        table.cell(session.session).cell(session.participant);
        table.cell(std::int64_t{session.simulated});
        write_trial(table, trial);
        table.end_row();
      }
    }
    table.finish();
  }

  void write_presentations() {
    CsvTableWriter table(folder_.path() / "presentations.csv", presentation_columns());
    for (const core::SessionRow& session : sessions_) {
      for (const core::PresentationRow& row : store_.presentations(session.session)) {
        table.cell(row.session).cell(session.participant);
        write_presentation(table, row);
        table.end_row();
      }
    }
    table.finish();
  }

  void write_events() {
    CsvTableWriter table(folder_.path() / "events.csv", event_columns());
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
    CsvTableWriter table(folder_.path() / "answers.csv", answer_columns());
    for (const core::SessionRow& session : sessions_) {
      for (const core::AnswerRow& row : store_.answers(session.session)) {
        table.cell(row.session).cell(session.participant).cell(row.stage).cell(row.item);
        table.cell(row.answer).end_row();
      }
    }
    table.finish();
  }

  void write_questionnaires() {
    CsvTableWriter table(folder_.path() / "questionnaires.csv", questionnaire_columns());
    for (const core::SessionRow& session : sessions_) {
      const std::vector<core::AnswerRow> answers = store_.answers(session.session);
      const nlohmann::json protocol =
          nlohmann::json::parse(store_.protocol(session.protocol_sha256).text, nullptr, false);
      for (const QuestionnaireItem& item : questionnaire_items(protocol)) {
        std::string given;
        for (const core::AnswerRow& row : answers) {
          if (row.stage == item.stage && row.item == item.name) given = row.answer;
        }
        table.cell(session.session).cell(session.participant).cell(item.stage);
        table.cell(item.name).cell(item.kind).cell(item.question).cell(item.unit);
        table.cell(item.num_steps > 0 ? std::optional<std::int64_t>(item.num_steps)
                                      : std::nullopt);
        table.cell(given).end_row();
      }
    }
    table.finish();
  }

  void write_recordings() {
    const fs::path folder = folder_.make("recordings");
    CsvTableWriter gaps(folder / "gaps.csv", gap_columns());
    for (const core::SessionRow& session : sessions_) {
      const fs::path file = store_.recording_file(session.session);
      if (fs::exists(file)) write_recording(session, file, folder, gaps);
    }
    gaps.finish();
  }

  void write_recording(const core::SessionRow& session, const fs::path& file,
                       const fs::path& folder, CsvTableWriter& gaps) {
    const core::RecordingReader reader(file);
    const bool with_joints = reader.has_joints();
    any_joints_ |= with_joints;
    const std::vector<RecordingColumn> columns = recording_columns(with_joints);
    CsvTableWriter table(folder / file.stem().concat(".csv"),
                         core::sample_column_names(with_joints), TableStyle::kCsv);
    GapFinder finder;
    reader.read(0, INT64_MAX, [&](const core::Sample& sample) {
      if (const auto gap = finder.tell(sample.tick)) {
        gaps.cell(session.session).cell(gap->first_tick).cell(gap->last_tick).end_row();
      }
      const std::vector<double> values = core::sample_values(sample, with_joints);
      for (std::size_t i = 0; i < values.size(); ++i) {
        table.fixed_cell(values[i], columns[i].decimals);
      }
      table.end_row();
    });
    table.finish();
  }

  void write_codebook() {
    CsvTableWriter table(
        folder_.path() / "codebook.csv",
        {{"file", "", ""}, {"column", "", ""}, {"unit", "", ""}, {"meaning", "", ""}});
    std::vector<std::pair<const char*, const std::vector<CsvColumn>*>> tables = {
        {"sessions.csv", &session_columns()},
        {"participants.csv", &participant_columns()},
        {"trials.csv", &trial_columns()},
        {"presentations.csv", &presentation_columns()},
        {"events.csv", &event_columns()},
        {"answers.csv", &answer_columns()},
        {"questionnaires.csv", &questionnaire_columns()}};
    if (options_.recordings) tables.emplace_back("recordings/gaps.csv", &gap_columns());
    for (const auto& [file, columns] : tables) {
      for (const CsvColumn& column : *columns) {
        table.cell(file).cell(column.name).cell(column.unit).cell(column.meaning).end_row();
      }
    }
    if (options_.recordings) {
      for (const RecordingColumn& column : recording_columns(any_joints_)) {
        table.cell("recordings/*.csv").cell(column.name).cell(column.unit);
        table.cell(column.meaning).end_row();
      }
    }
    table.finish();
  }

  const core::StudyStore& store_;
  const UnfinishedFolder& folder_;
  ExportOptions options_;
  std::vector<core::SessionRow> sessions_;
  bool any_joints_ = false;  ///< In any of the recordings.
};

}  // namespace

void export_csv(const core::StudyStore& store, const fs::path& folder,
                const ExportOptions& options) {
  UnfinishedFolder unfinished(folder);
  Export(store, unfinished, options).run();
  unfinished.publish();
}

}  // namespace jnd::analysis
