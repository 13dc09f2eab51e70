#include "core/storage/schedule.h"

#include "core/storage/backup_mark.h"
#include "core/storage/database.h"
#include "core/storage/study_format.h"
#include "core/storage/writer_lock.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFirstThatKnowsSchedules = 13;

/// A study that is opened to write to its schedule, with its lock.
class WrittenSchedule {
 public:
  explicit WrittenSchedule(const fs::path& folder)
      : lock_(checked(folder)),
        database_(folder / "study.sqlite", Database::Mode::kReadWrite,
                  Durability::kEveryCommit) {
    bring_up_to_date(database_);
  }
  [[nodiscard]] Database& database() noexcept { return database_; }

 private:
  static const fs::path& checked(const fs::path& folder) {
    require_study(folder);
    require_no_backup(folder);
    return folder;
  }

  WriterLock lock_;
  Database database_;
};

bool knows_schedules(Database& database) {
  return study_format_of(database) >= kFirstThatKnowsSchedules;
}

void write_appointment(Database& database, const AppointmentRow& row, std::int64_t time_ns) {
  Statement(database,
            "INSERT INTO appointment (appointment, participant, starts_time_ns, cancelled, "
            "time_ns) VALUES (?, ?, ?, ?, ?)")
      .bind(row.appointment)
      .bind(row.participant)
      .bind(row.starts_time_ns)
      .bind(std::int64_t{row.cancelled})
      .bind(time_ns)
      .run();
}

std::vector<AppointmentRow> last_rows(Database& database) {
  Statement rows(database,
                 "SELECT appointment, participant, starts_time_ns, cancelled FROM appointment "
                 "AS a WHERE entry = (SELECT MAX(entry) FROM appointment WHERE appointment = "
                 "a.appointment) ORDER BY starts_time_ns, appointment");
  std::vector<AppointmentRow> all;
  while (rows.step()) {
    all.push_back({.appointment = rows.integer(0),
                   .participant = rows.text(1),
                   .starts_time_ns = rows.integer(2),
                   .cancelled = rows.integer(3) != 0});
  }
  return all;
}

}  // namespace

std::int64_t add_appointment(const fs::path& folder, const std::string& participant,
                             std::int64_t starts_time_ns, std::int64_t time_ns) {
  WrittenSchedule study(folder);
  Transaction transaction(study.database());
  std::int64_t number = 1;
  {
    Statement last(study.database(), "SELECT COALESCE(MAX(appointment), 0) FROM appointment");
    if (last.step()) number = last.integer(0) + 1;
  }
  write_appointment(
      study.database(),
      {.appointment = number, .participant = participant, .starts_time_ns = starts_time_ns},
      time_ns);
  transaction.commit();
  return number;
}

void cancel_appointment(const fs::path& folder, std::int64_t appointment,
                        std::int64_t time_ns) {
  WrittenSchedule study(folder);
  for (AppointmentRow& row : last_rows(study.database())) {
    if (row.appointment != appointment || row.cancelled) continue;
    row.cancelled = true;
    return write_appointment(study.database(), row, time_ns);
  }
  throw Error(folder.string() + ": expected an appointment to cancel, found no number " +
              std::to_string(appointment) + " that stands");
}

void plan_number(const fs::path& folder, std::int64_t num_participants, std::int64_t time_ns) {
  if (num_participants < 1) {
    throw Error(folder.string() + ": expected a number of participants above 0, found " +
                std::to_string(num_participants));
  }
  WrittenSchedule study(folder);
  Statement(study.database(),
            "INSERT INTO planned_number (num_participants, time_ns) VALUES (?, ?)")
      .bind(num_participants)
      .bind(time_ns)
      .run();
}

std::vector<AppointmentRow> appointments(const fs::path& folder) {
  Database database(folder / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  if (!knows_schedules(database)) return {};
  return last_rows(database);
}

std::optional<std::int64_t> planned_number(const fs::path& folder) {
  Database database(folder / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  if (!knows_schedules(database)) return std::nullopt;
  Statement rows(database,
                 "SELECT num_participants FROM planned_number ORDER BY entry DESC LIMIT 1");
  if (!rows.step()) return std::nullopt;
  return rows.integer(0);
}

}  // namespace jnd::core
