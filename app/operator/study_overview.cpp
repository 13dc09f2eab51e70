#include "app/operator/study_overview.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/language/words.h"
#include "app/operator/study_words.h"
#include "app/preregistration/preregistration.h"
#include "app/session/pseudonym.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/backup_mark.h"
#include "core/storage/schedule.h"
#include "experiments/order/counterbalance.h"
#include "experiments/session/plan.h"

namespace jnd::app {
namespace {

using namespace experiments;
namespace fs = std::filesystem;

constexpr std::int64_t kNsPerDay = 86'400'000'000'000;
/// Up to so many cells are listed one by one; otherwise each factor that differs is listed by
/// itself.
constexpr std::size_t kMostCells = 12;

/// The cells of sessions that count, completed or open.
struct CountedCells {
  std::vector<std::string> done, open;
};

CountedCells counted_cells(const core::StudyStore& store, const StudyFolder& folder) {
  CountedCells cells{.done = completed_cells(store), .open = {}};
  for (const core::SessionRow& row : store.sessions()) {
    const auto line = std::ranges::find(folder.sessions, row.session, &SessionLine::session);
    if (line == folder.sessions.end() || line->pilot) continue;
    if (line->status == SessionLine::Status::kOpen) cells.open.push_back(row.cells);
  }
  return cells;
}

BalanceGroup balance_of_cells(const Study& study, const std::vector<Cell>& cells,
                              const CountedCells& counted) {
  BalanceGroup group;
  for (const Cell& cell : cells) {
    const std::string text = to_string(cell);
    group.lines.push_back(
        {.words = cell_words(study, cell),
         .num_done = static_cast<int>(std::ranges::count(counted.done, text)),
         .num_open = static_cast<int>(std::ranges::count(counted.open, text))});
  }
  return group;
}

BalanceGroup balance_of_factor(const Study& study, const Factor& factor,
                               const CountedCells& counted) {
  BalanceGroup group{.title = name_words(factor.name, /*as_title=*/true), .lines = {}};
  const auto num_in = [&](const std::vector<std::string>& cells,
                          const std::vector<std::string>& arms) {
    return static_cast<int>(std::ranges::count_if(cells, [&](const std::string& text) {
      try {
        const Cell cell = cell_from_text(study, text);
        const Assignment* its = find_assignment(cell, factor.name);
        return its != nullptr && its->arms == arms;
      } catch (const core::Error&) {
        return false;  // The cell belongs to another version of the study.
      }
    }));
  };
  for (const std::vector<std::string>& arms : factor.alternatives) {
    group.lines.push_back({.words = cell_words(study, {{factor.name, arms}}),
                           .num_done = num_in(counted.done, arms),
                           .num_open = num_in(counted.open, arms)});
  }
  return group;
}

std::vector<BalanceGroup> balance_of(const Study& study, const CountedCells& counted) {
  const std::vector<Factor> factors = factors_of(study);
  if (factors.empty()) return {};
  const std::vector<Cell> cells = cells_of(study);
  if (cells.size() <= kMostCells) return {balance_of_cells(study, cells, counted)};
  std::vector<BalanceGroup> groups;
  for (const Factor& factor : factors) {
    groups.push_back(balance_of_factor(study, factor, counted));
  }
  return groups;
}

/// Every combination of values of the participant's fields; one empty combination if the study
/// asks nothing.
std::vector<FieldValues> all_that_people_bring(const Study& study) {
  std::vector<FieldValues> all = {{}};
  for (const ParticipantField& field : study.participant_fields) {
    std::vector<FieldValues> more;
    for (const FieldValues& values : all) {
      for (const Option& option : field.options) {
        more.push_back(values);
        more.back()[field.name] = option.value;
      }
    }
    all = std::move(more);
  }
  return all;
}

std::string words_of_fields(const FieldValues& values) {
  std::string words;
  for (const auto& [name, value] : values) {
    words += (words.empty() ? "" : ", ") + name_words(name) + ": " + name_words(value);
  }
  return words;
}

void add_next_cells(const Study& study, const std::vector<std::string>& done,
                    std::uint64_t seed, std::int64_t num_sessions, StudyOverview& overview) {
  constexpr std::size_t kMostTold = 8;
  const std::vector<FieldValues> all = all_that_people_bring(study);
  if (all.size() > kMostTold) {
    overview.cell_problem = tr("It depends on what the participant brings, and is told then.");
    return;
  }
  for (const FieldValues& fields : all) {
    const Cell cell = planned_cells(study, done, seed, num_sessions, 1, fields).front();
    Cell assigned = cell;
    std::erase_if(assigned,
                  [&](const Assignment& one) { return fields.contains(one.counterbalance); });
    overview.next_cells.push_back(
        {.brings = words_of_fields(fields), .cell = cell_words(study, assigned)});
    if (overview.balance.size() != 1 || !overview.balance.front().title.empty()) continue;
    for (BalanceLine& line : overview.balance.front().lines) {
      if (all.size() == 1 && line.words == cell_words(study, cell)) line.is_next = true;
    }
  }
}

std::string age_words(std::int64_t age_ns) {
  const std::int64_t days = age_ns / kNsPerDay;
  if (days > 0) return trn("{} day ago", "{} days ago", days);
  return tr("{} ago",
            duration_words(1e-9 * static_cast<double>(std::max<std::int64_t>(age_ns, 0))));
}

BackupAge backup_age(const core::StudyStore& store, const StudyFolder& folder,
                     std::int64_t now_ns) {
  constexpr std::int64_t kOldAfterDays = 7;
  BackupAge age;
  std::int64_t newest_ns = 0;
  for (const core::KnownBackup& backup : core::dated_backups(folder.folder)) {
    if (core::is_unfinished_backup(backup.folder) || backup.time_ns < newest_ns) continue;
    age.is_known = true;
    newest_ns = backup.time_ns;
    age.folder = backup.folder.string();
    std::error_code ignored;
    age.is_away = !fs::exists(backup.folder / "study.sqlite", ignored);
  }
  age.is_elsewhere = folder.is_safe_elsewhere;
  for (const core::SessionOverview& one : store.overview()) {
    age.num_newer_sessions += one.last_time_ns.value_or(0) > newest_ns ? 1 : 0;
  }
  if (age.is_known) age.when = age_words(now_ns - newest_ns);
  if (folder.sessions.empty() || folder.is_backup) return age;
  if (!age.is_known) {
    age.hint = tr("A disk that fails takes every answer.");
  } else if (age.num_newer_sessions > 0) {
    age.hint = trn("{} session is newer than the copy. Bring it up to date.",
                   "{} sessions are newer than the copy. Bring it up to date.",
                   age.num_newer_sessions);
    if (now_ns - newest_ns > kOldAfterDays * kNsPerDay) {
      age.hint = tr("The copy is old. {}", age.hint);
    }
  } else if (age.is_away) {
    age.hint = tr("The copy is not in its place now. Is its disk attached?");
  } else if (!age.is_elsewhere) {
    age.hint = tr("It lies on the study's own disk: keep another one elsewhere.");
  }
  return age;
}

}  // namespace

std::optional<PlannedNumber> planned_elsewhere(const core::StudyStore& store,
                                               const Study& study) {
  if (study.sequential && !study.sequential->looks.empty()) {
    return PlannedNumber{study.sequential->looks.back(), tr("by its last look")};
  }
  const std::optional<std::string> kept = kept_preregistration(store);
  if (!kept) return std::nullopt;
  const auto plan = nlohmann::json::parse(*kept, nullptr, /*allow_exceptions=*/false);
  if (!plan.is_object() || !plan.contains("num_participants") ||
      !plan["num_participants"].is_number_integer()) {
    return std::nullopt;
  }
  return PlannedNumber{plan["num_participants"].get<std::int64_t>(), tr("preregistered")};
}

StudyOverview study_overview(const fs::path& folder, std::uint64_t seed, WorkControl& control,
                             std::int64_t now_ns) {
  const StudyFolder opened = open_study_folder(folder, now_ns);
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  const Study study = study_in(store);
  StudyOverview overview{.hides_levels = opened.hides_levels,
                         .is_backup = opened.is_backup,
                         .num_done = opened.num_participants_done};
  if (const std::optional<PlannedNumber> planned = planned_elsewhere(store, study)) {
    overview.num_planned = planned->num_participants;
    overview.planned_by = planned->by;
  } else {
    overview.num_planned = core::planned_number(folder);
  }
  const std::vector<core::SessionRow> sessions = store.sessions();
  if (!overview.hides_levels) {
    const CountedCells counted = counted_cells(store, opened);
    overview.balance = balance_of(study, counted);
    add_next_cells(study, counted.done, seed, std::ssize(sessions), overview);
  }
  const std::vector<core::AppointmentRow> appointments = core::appointments(folder);
  overview.schedule = schedule_of(appointments, opened, now_ns);
  overview.next_participant = next_participant(store, appointments, now_ns);
  overview.free_pseudonym = free_pseudonym(store, appointments);
  overview.backup = backup_age(store, opened, now_ns);
  for (const core::SessionRow& row : sessions) {
    control.stop_if_cancelled();
    overview.quality.push_back(quality_of(store, row, opened.hides_levels));
    control.progress(static_cast<double>(overview.quality.size()) /
                     static_cast<double>(sessions.size()));
  }
  return overview;
}

void write_appointment(const fs::path& folder, const std::string& participant,
                       const std::string& date, const std::string& hour) {
  if (!is_pseudonym(participant)) {
    throw core::Error(tr("expected a pseudonym ({}), found “{}”; write no name of a person",
                         pseudonym_words(), participant));
  }
  const std::optional<std::int64_t> starts_ns = time_of_texts(date, hour);
  if (!starts_ns) {
    throw core::Error(tr(
        "expected a day as 2026-12-01 and a time as 14:30, found “{}” and “{}”", date, hour));
  }
  for (const core::AppointmentRow& row : core::appointments(folder)) {
    if (row.cancelled || row.participant != participant || row.starts_time_ns != *starts_ns) {
      continue;
    }
    throw core::Error(tr("{} is written down for that time already", participant));
  }
  (void)core::add_appointment(folder, participant, *starts_ns, core::SystemClock().now_ns());
}

void cancel_appointment_of(const fs::path& folder, std::int64_t appointment) {
  core::cancel_appointment(folder, appointment, core::SystemClock().now_ns());
}

void write_planned_number(const fs::path& folder, const std::string& typed) {
  std::int64_t number = 0;
  const char* const end = typed.data() + typed.size();
  const auto [stopped, error] = std::from_chars(typed.data(), end, number);
  constexpr std::int64_t kMostPlanned = 100'000;
  if (error != std::errc() || stopped != end || number < 1 || number > kMostPlanned) {
    throw core::Error(tr("expected a whole number of participants from 1, found “{}”", typed));
  }
  {
    const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
    if (const auto planned = planned_elsewhere(store, study_in(store))) {
      throw core::Error(tr("{} participants are planned ({}), which this does not change",
                           planned->num_participants, planned->by));
    }
  }
  core::plan_number(folder, number, core::SystemClock().now_ns());
}

}  // namespace jnd::app
