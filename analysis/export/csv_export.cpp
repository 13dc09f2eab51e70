#include "analysis/export/csv_export.h"

#include <algorithm>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/export/bids_text.h"
#include "analysis/export/csv_table_writer.h"
#include "analysis/export/exported_profiles.h"
#include "analysis/export/exported_recording.h"
#include "analysis/export/recording_columns.h"
#include "analysis/export/recording_rows.h"
#include "analysis/export/study_tables.h"
#include "analysis/export/table_rows.h"
#include "analysis/export/unfinished_folder.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

/// A row of participants.csv.
struct Participant {
  bool simulated = false;
  std::int64_t num_sessions = 0, num_completed = 0, num_trials = 0, num_excluded = 0;
  /// The fields that were known before the last session.
  std::map<std::string, std::string> fields;
};

/// A field of the study as a column of participants.csv.
struct FieldColumn {
  std::string field, name, meaning;
};

/// For example "Sex?, as was known before the session: female (a woman), male (a man)".
std::string field_meaning(const QuestionnaireItem& field) {
  std::string text = (field.question.empty() ? field.name : field.question) +
                     ", as was known before the session";
  for (std::size_t i = 0; i < field.options.size(); ++i) {
    const std::string& label = field.option_labels.at(i);
    text +=
        (i == 0 ? ": " : ", ") + field.options[i] + (label.empty() ? "" : " (" + label + ")");
  }
  return text;
}

/// The rows of one session in the tables.
struct SessionRows {
  bool completed = false;
  std::vector<ExportedTrial> trials;
  std::vector<ExportedPresentation> presentations;
  std::vector<core::EventRow> events;
  std::vector<core::AnswerRow> answers;
  std::vector<QuestionnaireItem> questions;
  std::vector<ExportedAnswer> question_answers;
};

/// The share of the tables in the time of an export with samples, for its progress.
constexpr double kShareOfTables = 0.05;

class CsvExport {
 public:
  CsvExport(const core::StudyStore& store, const UnfinishedFolder& folder,
            const ExportOptions& options)
      : store_(store),
        folder_(folder),
        options_(options),
        sessions_(exported_sessions(store, options)),
        factors_(store, sessions_, trial_columns()) {
    find_fields();
  }

  ExportOutcome run() {
    write_tables();
    write_participants();
    write_device_profiles();
    write_laboratories();
    if (is_registered()) write_deviation_table();
    if (options_.recordings) write_recordings();
    write_codebook_table();
    return std::move(outcome_);
  }

 private:
  void find_fields() {
    StoredStudies studies(store_);
    std::vector<QuestionnaireItem> fields;
    std::set<std::string> seen;
    for (const core::SessionRow& session : sessions_) {
      if (!seen.insert(session.protocol_sha256).second) continue;
      merge_items(fields, participant_fields(studies.study(session.protocol_sha256)));
    }
    std::vector<std::string> taken;
    for (const CsvColumn& column : participant_columns()) taken.emplace_back(column.name);
    for (const QuestionnaireItem& field : fields) {
      fields_.push_back({field.name, field_column(field.name, taken), field_meaning(field)});
    }
    participant_columns_ = participant_columns();
    for (const FieldColumn& field : fields_) {
      participant_columns_.push_back({field.name.c_str(), "", field.meaning.c_str()});
    }
  }

  /// Writes all tables with rows of sessions, so that the store is asked for each session once.
  void write_tables() {
    CsvTableWriter sessions = table("sessions.csv", session_columns());
    CsvTableWriter session_values = table("session_values.csv", session_value_columns());
    CsvTableWriter trials = table("trials.csv", factors_.columns());
    CsvTableWriter presentations = table("presentations.csv", presentation_columns());
    CsvTableWriter events = table("events.csv", event_columns());
    CsvTableWriter markers = table("markers.csv", marker_columns());
    CsvTableWriter answers = table("answers.csv", answer_columns());
    CsvTableWriter questionnaires = table("questionnaires.csv", questionnaire_columns());
    CsvTableWriter after_trials = table("questions.csv", question_columns());
    StudyQuestions questions(store_);
    const auto read_ahead = [&](std::size_t i) {
      return std::async(std::launch::async, [this, &questions, i] {
        return i < sessions_.size() ? read(sessions_[i], questions) : SessionRows{};
      });
    };
    // The next session is read while this one is written.
    std::future<SessionRows> next = read_ahead(0);
    const core::Progress tables =
        core::part_of(options_.on_progress, 0.0, options_.recordings ? kShareOfTables : 1.0);
    for (std::size_t i = 0; i < sessions_.size(); ++i) {
      if (options_.keep_going) options_.keep_going();
      core::tell(tables, i, sessions_.size());
      const SessionRows rows = next.get();
      next = read_ahead(i + 1);
      const core::SessionRow& session = sessions_[i];
      write_session(sessions, session, rows.completed, rows.events);
      write_session_values(session_values, session, rows.events);
      write_trials(trials, session, rows.trials, factors_);
      write_presentations(presentations, session, rows.presentations);
      write_events(events, session, rows.events);
      write_markers(markers, session, rows.events);
      write_answers(answers, session, rows.answers);
      write_questionnaire(questionnaires, session, rows.answers, rows.questions);
      write_questions(after_trials, session, rows.question_answers);
      count(session, rows);
    }
    for (CsvTableWriter* one : {&sessions, &session_values, &trials, &presentations, &events,
                                &markers, &answers, &questionnaires, &after_trials}) {
      one->finish();
    }
  }

  [[nodiscard]] SessionRows read(const core::SessionRow& session,
                                 StudyQuestions& questions) const {
    SessionRows rows{.completed = store_.completed(session.session),
                     .trials = exported_trials(store_, session.session, options_.selection),
                     .events = store_.events(session.session),
                     .answers = store_.answers(session.session),
                     .questions = questions.of(session)};
    rows.presentations = exported_presentations(store_, session.session, rows.trials);
    rows.question_answers = exported_question_answers(store_, session.session, rows.trials);
    return rows;
  }

  void count(const core::SessionRow& session, const SessionRows& rows) {
    Participant& participant = participants_[session.participant];
    participant.simulated |= session.simulated;
    ++participant.num_sessions;
    participant.num_completed += std::int64_t{rows.completed};
    participant.num_trials += std::ssize(rows.trials);
    for (const core::AnswerRow& row : rows.answers) {
      if (row.stage == kFieldsStage) participant.fields[row.item] = row.answer;
    }
    for (const ExportedTrial& trial : rows.trials) {
      participant.num_excluded += std::int64_t{trial.excluded};
    }
  }

  void write_participants() {
    CsvTableWriter rows = table("participants.csv", participant_columns_);
    for (auto& [participant, one] : participants_) {
      rows.cell(participant).cell(one.simulated).cell(one.num_sessions);
      rows.cell(one.num_completed).cell(one.num_trials).cell(one.num_excluded);
      for (const FieldColumn& field : fields_) rows.cell(one.fields[field.field]);
      rows.end_row();
    }
    rows.finish();
  }

  void write_device_profiles() {
    const std::vector<core::DeviceProfileRow> profiles = exported_profiles(store_, sessions_);
    if (profiles.empty()) return;
    const fs::path place = folder_.make("device_profiles");
    for (const core::DeviceProfileRow& profile : profiles) {
      write_text(place / profile_file_name(profile), profile.text);
    }
  }

  [[nodiscard]] bool is_registered() const {
    return !options_.preregistration.registered_on.empty();
  }

  void write_deviation_table() const {
    CsvTableWriter rows = table("deviations.csv", deviation_columns());
    write_deviations(rows, options_.preregistration);
    rows.finish();
  }

  void write_laboratories() {
    const std::vector<ExportedLaboratory> laboratories = exported_laboratories(sessions_);
    if (laboratories.empty()) return;
    const fs::path place = folder_.make("laboratories");
    for (const ExportedLaboratory& one : laboratories) {
      write_text(place / one.file_name(), one.text);
    }
  }

  void write_recordings() {
    (void)folder_.make("recordings");
    CsvTableWriter gaps = table("recordings/gaps.csv", gap_columns());
    const core::Progress recordings = core::part_of(options_.on_progress, kShareOfTables, 1.0);
    std::size_t num_done = 0;
    for (const core::SessionRow& session : sessions_) {
      core::tell(recordings, num_done++, sessions_.size());
      const ExportedRecording recording(store_, session, options_);
      if (!recording.problem().empty()) outcome_.problems.push_back(recording.problem());
      write_gaps(gaps, session, recording);
      if (!recording.any()) continue;
      const std::vector<ExportedTrial> trials =
          exported_trials(store_, session.session, options_.selection);
      write_recording(
          session,
          {recording, session, options_.selection,
           ticks_of_blocks(trials, exported_presentations(store_, session.session, trials),
                           options_.selection)});
    }
    gaps.finish();
  }

  void write_recording(const core::SessionRow& session, const RecordingRows& rows) {
    outcome_.samples = true;
    const std::vector<RecordingColumn>& columns = rows.columns();
    std::vector<std::string> names;
    for (const RecordingColumn& column : columns) {
      names.push_back(column.name());
      if (std::ranges::find(told_, column.name(), &RecordingColumn::name) == told_.end()) {
        told_.push_back(column);
      }
    }
    const fs::path name = store_.recording_file(session.session).stem().concat(".csv");
    CsvTableWriter samples(folder_.path() / "recordings" / name, names, TableStyle::kCsv);
    rows.read([&](const std::vector<double>& values) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        samples.fixed_cell(values[i], columns[i].decimals, columns[i].tolerance);
      }
      samples.end_row();
    });
    samples.finish();
  }

  void write_codebook_table() {
    CsvTableWriter rows = table("codebook.csv", codebook_columns());
    rows.cell("*.csv").cell("*").cell("").cell(kTextsOfTables).end_row();
    std::vector<std::pair<std::string, const std::vector<CsvColumn>*>> tables = {
        {"sessions.csv", &session_columns()},
        {"session_values.csv", &session_value_columns()},
        {"participants.csv", &participant_columns_},
        {"trials.csv", &factors_.columns()},
        {"presentations.csv", &presentation_columns()},
        {"events.csv", &event_columns()},
        {"markers.csv", &marker_columns()},
        {"answers.csv", &answer_columns()},
        {"questionnaires.csv", &questionnaire_columns()},
        {"questions.csv", &question_columns()},
        {"codebook.csv", &codebook_columns()}};
    if (options_.recordings) tables.emplace_back("recordings/gaps.csv", &gap_columns());
    if (is_registered()) tables.emplace_back("deviations.csv", &deviation_columns());
    write_codebook(rows, tables);
    if (options_.recordings) {
      for (const RecordingColumn& column : told_) {
        rows.cell("recordings/*.csv").cell(column.name()).cell(column.unit);
        rows.cell(column.meaning).end_row();
      }
    }
    rows.finish();
  }

  [[nodiscard]] CsvTableWriter table(const char* name,
                                     const std::vector<CsvColumn>& columns) const {
    return {folder_.path() / name, columns};
  }

  const core::StudyStore& store_;
  const UnfinishedFolder& folder_;
  const ExportOptions& options_;
  std::vector<core::SessionRow> sessions_;
  FactorColumns factors_;
  std::map<std::string, Participant> participants_;
  std::vector<FieldColumn> fields_;
  std::vector<CsvColumn> participant_columns_;  ///< Its texts are owned by `fields_`.
  std::vector<RecordingColumn> told_;           ///< The columns that any of the recordings has.
  ExportOutcome outcome_;
};

}  // namespace

ExportOutcome export_csv(const core::StudyStore& store, const fs::path& folder,
                         const ExportOptions& options) {
  ExportOutcome outcome;
  write_folder(folder, [&](const UnfinishedFolder& unfinished) {
    outcome = CsvExport(store, unfinished, options).run();
  });
  return outcome;
}

}  // namespace jnd::analysis
