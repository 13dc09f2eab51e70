#include "analysis/data/trial_records.h"

#include <map>
#include <string>
#include <utility>

#include "analysis/data/json_fields.h"
#include "experiments/study/media.h"

namespace jnd::analysis {
namespace {

using ByTrial = std::map<std::int64_t, TrialRecord>;

TrialRecord* find(ByTrial& records, const std::optional<std::int64_t>& trial) {
  const auto found = trial ? records.find(*trial) : records.end();
  return found == records.end() ? nullptr : &found->second;
}

std::optional<double> level_of(const core::DesignRow& row) {
  if (row.target_percent) return row.target_percent;
  // If the test is adjusted, the standard is the level.
  return row.starting_intensity ? row.reference_intensity : row.intensity;
}

bool missed_deadline(const core::EventRow& event) {
  const nlohmann::json data = object_in(event.data);
  const auto found = data.find("missed_deadline");
  return found != data.end() && found->is_boolean() && found->get<bool>();
}

void add_events(const core::StudyStore& store, std::int64_t session, ByTrial& records) {
  TrialRecord* under_way = nullptr;
  for (const core::EventRow& event : store.events(session)) {
    TrialRecord* const record = find(records, event.trial);
    if (event.kind == "trial_started") under_way = record;
    if (event.kind == "fault_raised" && under_way != nullptr) under_way->is_faulted = true;
    if (event.kind == "trial_answered" || event.kind == "attempt_discarded") {
      under_way = nullptr;
    }
    if (record == nullptr) continue;
    record->num_undone += event.kind == "answer_undone" ? 1 : 0;
    if (event.kind != "attempt_discarded") continue;
    ++record->num_discarded;
    record->num_missed_deadline += missed_deadline(event) ? 1 : 0;
  }
}

}  // namespace

std::vector<TrialRecord> trial_records(const core::StudyStore& store, std::int64_t session) {
  ByTrial records;
  std::map<std::int64_t, bool> is_pressed;
  for (const core::DesignRow& row : store.design(session)) {
    records[row.trial] = {.session = session,
                          .trial = row.trial,
                          .block = row.block,
                          .level = level_of(row),
                          .is_catch = row.is_catch};
    is_pressed[row.trial] = experiments::is_pressed(row.medium);
  }
  for (const core::TrialRow& row : store.trials(session, /*include_excluded=*/true)) {
    if (TrialRecord* const record = find(records, row.trial)) record->is_set_aside = true;
  }
  for (const core::TrialRow& row : store.trials(session)) {
    if (TrialRecord* const record = find(records, row.trial)) {
      record->is_answered = true;
      record->is_set_aside = false;
    }
  }
  // Indexed by trial and interval.
  std::map<std::pair<std::int64_t, std::string>, bool> has_stroke;
  for (const core::PresentationRow& row : store.presentations(session)) {
    TrialRecord* const record = find(records, row.trial);
    if (record == nullptr || row.interval == "free_space") continue;
    if (row.measures.limited_ticks > 0) record->is_limited = true;
    if (!is_pressed[row.trial])
      has_stroke[{row.trial, row.interval}] |= row.measures.num_strokes > 0;
  }
  for (const auto& [presented, has] : has_stroke) {
    if (!has) records.at(presented.first).is_strokeless = true;
  }
  add_events(store, session, records);
  std::vector<TrialRecord> all;
  for (auto& [trial, record] : records) all.push_back(std::move(record));
  return all;
}

}  // namespace jnd::analysis
