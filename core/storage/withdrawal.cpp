#include "core/storage/withdrawal.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/storage/backup.h"
#include "core/storage/database.h"
#include "core/storage/files.h"
#include "core/storage/study_format.h"
#include "core/storage/study_store.h"
#include "core/storage/table_rules.h"
#include "core/storage/writer_lock.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

std::vector<std::int64_t> sessions_in(Database& database, const std::string& table,
                                      const std::string& participant) {
  Statement rows(database,
                 "SELECT session FROM " + table + " WHERE participant = ? ORDER BY session");
  rows.bind(participant);
  std::vector<std::int64_t> sessions;
  while (rows.step()) sessions.push_back(rows.integer(0));
  return sessions;
}

/// Returns names and texts of the triggers that keep rows from being deleted.
std::vector<std::pair<std::string, std::string>> guards(Database& database) {
  Statement rows(database,
                 "SELECT name, sql FROM sqlite_master WHERE type = 'trigger' AND name LIKE "
                 "'%\\_stays' ESCAPE '\\'");
  std::vector<std::pair<std::string, std::string>> all;
  while (rows.step()) all.emplace_back(rows.text(0), rows.text(1));
  return all;
}

// The states of a withdrawal, as they are stored.
/// The rows are gone, but their bytes may still be in the file.
constexpr const char* kBegun = "begun";
constexpr const char* kErased = "erased";      ///< Nothing is left in this folder.
constexpr const char* kFinished = "finished";  ///< Nothing is left in any known backup either.

std::string state_of(Database& database, const std::string& participant) {
  Statement row(database,
                "SELECT state FROM withdrawal_step WHERE participant = ? ORDER BY step DESC");
  row.bind(participant);
  return row.step() ? row.text(0) : "";
}

void note_state(Database& database, const std::string& participant, const char* state,
                std::int64_t time_ns) {
  if (state_of(database, participant) == state) return;
  Statement(database,
            "INSERT INTO withdrawal_step (participant, state, time_ns) VALUES (?, ?, ?)")
      .bind(participant)
      .bind(std::string(state))
      .bind(time_ns)
      .run();
}

void leave_tombstone(Database& database, std::int64_t session, std::int64_t time_ns) {
  Statement(database,
            "INSERT INTO withdrawal SELECT session, participant, ?,"
            " (SELECT COUNT(*) FROM event WHERE event.session = s.session),"
            " (SELECT COUNT(*) FROM trial WHERE trial.session = s.session)"
            " FROM session AS s WHERE session = ?")
      .bind(time_ns)
      .bind(session)
      .run();
}

/// A person who has an appointment and never came can withdraw as well.
bool has_rows_without_session(Database& database, const std::string& participant) {
  return std::ranges::any_of(table_rules(database), [&](const TableRule& rule) {
    return rule.erased_by == "participant" &&
           Statement(database, "SELECT 1 FROM " + rule.table + " WHERE participant = ?")
               .bind(participant)
               .step();
  });
}

/// Deletes all rows of the sessions in one transaction, or none. The transaction also notes
/// that the deleted bytes may still be readable in the file.
void delete_rows(Database& database, const std::string& participant,
                 const std::vector<std::int64_t>& sessions, std::int64_t time_ns) {
  Transaction transaction(database);
  note_state(database, participant, kBegun, time_ns);
  const auto all_guards = guards(database);
  for (const auto& [name, sql] : all_guards) database.execute("DROP TRIGGER " + name);
  for (const std::int64_t session : sessions) leave_tombstone(database, session, time_ns);
  // Rows of one table refer to those of another, in whatever order the tables come.
  database.execute("PRAGMA defer_foreign_keys = ON");
  for (const TableRule& rule : table_rules(database)) {
    const std::string deletion = "DELETE FROM " + rule.table + " WHERE " + rule.erased_by;
    if (rule.erased_by == "participant") {
      Statement(database, deletion + " = ?").bind(participant).run();
    } else if (rule.erased_by == "session") {
      for (const std::int64_t session : sessions) {
        Statement(database, deletion + " = ?").bind(session).run();
      }
    }
  }
  for (const auto& [name, sql] : all_guards) database.execute(sql);
  transaction.commit();
}

/// Removes recordings of these sessions for which the folder has no session. An interrupted
/// backup leaves such recordings.
void remove_unknown_recordings(const StudyStore& store,
                               const std::vector<std::int64_t>& sessions) {
  std::vector<std::int64_t> known;
  for (const SessionRow& row : store.sessions()) known.push_back(row.session);
  for (const std::int64_t session : sessions) {
    if (std::ranges::find(known, session) == known.end()) {
      remove_recording(store.recording_file(session));
    }
  }
}

/// What one folder ever had of a participant.
struct Erased {
  bool anything = false;
  std::vector<std::int64_t> sessions;
};

/// Deletes what one folder holds of the participant. `sessions` are those that the study had,
/// if the folder is a copy of it.
Erased erase_in(const fs::path& folder, const std::string& participant, std::int64_t time_ns,
                const std::vector<std::int64_t>& sessions = {}) {
  require_study(folder);
  const WriterLock lock(folder);
  Database database(folder / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  bring_up_to_date(database);
  // Freed pages are overwritten with zeros. VACUUM and the emptied log leave no old ones.
  database.execute("PRAGMA secure_delete = ON");
  const std::vector<std::int64_t> there = sessions_in(database, "session", participant);
  if (!there.empty() || has_rows_without_session(database, participant)) {
    delete_rows(database, participant, there, time_ns);
  }
  const std::vector<std::int64_t> gone = sessions_in(database, "withdrawal", participant);
  {
    const StudyStore store(folder, StudyStore::Mode::kReadOnly);
    for (const std::int64_t session : gone) remove_recording(store.recording_file(session));
    remove_unknown_recordings(store, sessions);
  }
  // Withdrawals in older layouts have no state.
  Erased erased{.anything = !gone.empty() || !state_of(database, participant).empty(),
                .sessions = gone};
  if (!erased.anything) return erased;
  database.execute("VACUUM");
  database.checkpoint();
  if (state_of(database, participant) != kFinished) {
    note_state(database, participant, kErased, time_ns);
  }
  return erased;
}

void finish_in(const fs::path& folder, const std::string& participant, std::int64_t time_ns) {
  const WriterLock lock(folder);
  Database database(folder / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  note_state(database, participant, kFinished, time_ns);
}

/// Adds notes that the backup has and the study lacks, in their place among the study's notes.
void add_notes(std::vector<ExportNote>& notes, const std::vector<ExportNote>& further) {
  for (const ExportNote& note : further) {
    const bool known = std::ranges::any_of(notes, [&](const ExportNote& one) {
      return one.place == note.place && one.time_ns == note.time_ns && one.kind == note.kind;
    });
    if (known) continue;
    const auto later = std::ranges::find_if(
        notes, [&](const ExportNote& one) { return one.time_ns > note.time_ns; });
    notes.insert(later, note);
  }
}

std::string id_of(const fs::path& folder) {
  return StudyStore(folder, StudyStore::Mode::kReadOnly).study_id();
}

}  // namespace

WithdrawalReport withdraw(const fs::path& folder, const std::string& participant,
                          std::int64_t time_ns) {
  WithdrawalReport report;
  const Erased erased = erase_in(folder, participant, time_ns);
  report.sessions = erased.sessions;
  if (!erased.anything) {
    throw Error(folder.string() +
                ": expected a participant of this study, found no session of " + participant);
  }
  const std::string study_id = id_of(folder);
  std::vector<ExportNote> notes = noted_exports(folder);
  // A backup may have been backed up itself, and know of copies that the study does not know.
  std::vector<fs::path> folders = known_backups(folder);
  for (std::size_t next = 0; next < folders.size(); ++next) {
    const fs::path backup = folders[next];
    try {
      if (fs::exists(backup) && fs::equivalent(backup, folder)) continue;
      require_study(backup);
      if (id_of(backup) != study_id) {
        throw Error(backup.string() + ": expected a backup of this study, found another study");
      }
      for (const fs::path& further : known_backups(backup)) {
        if (std::find(folders.begin(), folders.end(), further) == folders.end()) {
          folders.push_back(further);
        }
      }
      add_notes(notes, noted_exports(backup));
      if (erase_in(backup, participant, time_ns, report.sessions).anything) {
        finish_in(backup, participant, time_ns);
      }
      report.backups.push_back(backup);
    } catch (const std::exception& failure) {
      report.remaining.emplace_back(failure.what());
    }
  }
  if (report.remaining.empty()) finish_in(folder, participant, time_ns);
  report.exports = exports_still_there(notes, report.sessions);
  return report;
}

}  // namespace jnd::core
