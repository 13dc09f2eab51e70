#include "analysis/export/table_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace jnd::analysis {
namespace {

/// On one line, so that tools which know no quoted line ends read the table, too.
std::string on_one_line(const std::string& json_text) {
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(json_text, nullptr, false);
  return json.is_discarded() ? json_text : json.dump();
}

TableWriter& begin_row(TableWriter& table, const core::SessionRow& session) {
  return table.cell(session.session).cell(session.participant).cell(session.simulated);
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

}  // namespace

std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                           std::int64_t session) {
  std::vector<std::int64_t> standing;
  for (const core::TrialRow& row : store.trials(session)) standing.push_back(row.sequence);
  std::sort(standing.begin(), standing.end());
  const std::string hash = store.session(session).protocol_sha256;
  StoredStudies studies(store);
  std::vector<ExportedTrial> trials;
  for (core::TrialRow& row : store.trials(session, true)) {
    const bool stands = std::binary_search(standing.begin(), standing.end(), row.sequence);
    const experiments::Block& block = studies.block(hash, row.block);
    trials.push_back({.row = std::move(row),
                      .excluded = !stands,
                      .is_practice = block.practice.has_value(),
                      .standard_medium = block.standard_medium});
  }
  return trials;
}

std::vector<ExportedPresentation> exported_presentations(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials) {
  std::set<std::int64_t> excluded;
  for (const ExportedTrial& trial : trials) {
    if (trial.excluded) excluded.insert(trial.row.trial);
  }
  std::vector<ExportedPresentation> presentations;
  for (core::PresentationRow& row : store.presentations(session, true)) {
    const bool is_excluded = excluded.contains(row.trial);
    presentations.push_back({.row = std::move(row), .excluded = is_excluded});
  }
  return presentations;
}

const std::vector<QuestionnaireItem>& StudyQuestions::of(const core::SessionRow& session) {
  const auto [found, is_new] = by_hash_.try_emplace(session.protocol_sha256);
  if (is_new) {
    found->second = questionnaire_items(studies_.study(session.protocol_sha256));
  }
  return found->second;
}

std::string field_column(const std::string& field, const std::vector<std::string>& taken) {
  return std::ranges::find(taken, field) == taken.end() ? field : "field_" + field;
}

void write_session(TableWriter& table, const core::SessionRow& session, bool completed,
                   const std::vector<core::EventRow>& events) {
  const SessionStart start = start_of(events);
  begin_row(table, session).cell(session.cells).cell(std::to_string(session.seed));
  table.cell(session.pilot).cell(completed).cell(session.device);
  table.cell(session.rate_hz).cell(session.realtime).cell(session.recorded);
  table.cell(session.program_version).cell(session.protocol_sha256);
  table.cell(start.language).cell(start.fields).cell(session.started_time_ns);
  table.cell(on_one_line(session.laboratory)).end_row();
}

void write_trial_cells(TableWriter& table, const core::SessionRow& session,
                       const ExportedTrial& trial) {
  const core::TrialRow& row = trial.row;
  table.cell(session.simulated).cell(row.trial).cell(row.attempt).cell(row.block);
  table.cell(row.procedure).cell(row.medium).cell(row.quantity).cell(row.repetition);
  table.cell(row.position).cell(row.series).cell(row.test_interval);
  table.cell(row.is_catch)
      .cell(trial.is_practice)
      .cell(row.intensity)
      .cell(row.reference_intensity)
      .cell(trial.standard_medium);
  table.cell(row.starting_intensity).cell(row.target_percent).cell(row.response);
  table.cell(row.response_time_s).cell(row.num_presentations).cell(row.num_steps);
  table.cell(row.first_tick).cell(row.last_tick).cell(trial.excluded);
}

void write_trials(TableWriter& table, const core::SessionRow& session,
                  const std::vector<ExportedTrial>& trials) {
  for (const ExportedTrial& trial : trials) {
    table.cell(session.session).cell(session.participant);
    write_trial_cells(table, session, trial);
    table.end_row();
  }
}

void write_presentations(TableWriter& table, const core::SessionRow& session,
                         const std::vector<ExportedPresentation>& presentations) {
  for (const auto& [row, excluded] : presentations) {
    begin_row(table, session).cell(row.trial).cell(row.attempt).cell(row.presentation);
    table.cell(row.interval).cell(row.intensity).cell(row.first_tick).cell(row.last_tick);
    table.cell(row.num_strokes).cell(row.stroke_width_m).cell(row.max_speed_m_per_s);
    table.cell(row.mean_height_m).cell(row.delivered_damping_n_s_per_m);
    table.cell(row.commanded_damping_n_s_per_m).cell(row.limited_ticks).cell(row.missed_ticks);
    table.cell(row.finger_lag_s).cell(excluded).end_row();
  }
}

void write_events(TableWriter& table, const core::SessionRow& session,
                  const std::vector<core::EventRow>& events) {
  for (const core::EventRow& row : events) {
    begin_row(table, session).cell(row.sequence).cell(row.kind);
    table.cell(std::int64_t{row.version}).cell(row.time_ns).cell(row.stage).cell(row.trial);
    table.cell(row.attempt).cell(row.first_tick).cell(row.last_tick).cell(row.intensity);
    table.cell(row.supersedes).cell(row.data).end_row();
  }
}

void write_answers(TableWriter& table, const core::SessionRow& session,
                   const std::vector<core::AnswerRow>& answers) {
  for (const core::AnswerRow& row : answers) {
    begin_row(table, session).cell(row.stage).cell(row.item).cell(row.answer).end_row();
  }
}

void write_questionnaire(TableWriter& table, const core::SessionRow& session,
                         const std::vector<core::AnswerRow>& answers,
                         const std::vector<QuestionnaireItem>& questions) {
  for (const QuestionnaireItem& item : questions) {
    std::string given;
    for (const core::AnswerRow& row : answers) {
      if (row.stage == item.stage && row.item == item.name) given = row.answer;
    }
    begin_row(table, session).cell(item.stage).cell(item.name).cell(item.kind);
    table.cell(item.question).cell(item.unit);
    table.cell(item.num_steps > 0 ? std::optional<std::int64_t>(item.num_steps) : std::nullopt);
    table.cell(given).end_row();
  }
}

void write_gaps(TableWriter& table, const core::SessionRow& session,
                const ExportedRecording& recording) {
  for (const core::TickRange& gap : recording.gaps()) {
    begin_row(table, session).cell(gap.first_tick).cell(gap.last_tick);
    table.cell(recording.num_missed(gap)).end_row();
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
