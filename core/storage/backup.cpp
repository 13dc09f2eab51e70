#include "core/storage/backup.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/storage/backup_mark.h"
#include "core/storage/database.h"
#include "core/storage/export_note.h"
#include "core/storage/files.h"
#include "core/storage/flight_record.h"
#include "core/storage/recording.h"
#include "core/storage/stream_file.h"
#include "core/storage/study_format.h"
#include "core/storage/study_store.h"
#include "core/storage/table_rules.h"
#include "core/storage/writer_lock.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

constexpr Durability kDurable = Durability::kEveryCommit;

/// Throws `Error` unless the target is new, empty or an earlier copy of the same study.
void require_own_target(const fs::path& folder, const fs::path& target,
                        const std::string& study_id) {
  if (!fs::exists(target)) return;
  const std::string place =
      target.string() + ": expected an empty folder or an earlier backup ";
  if (fs::exists(folder) && fs::equivalent(folder, target)) {
    throw Error(place + "of the study, found the study itself; choose another folder");
  }
  if (!fs::is_directory(target)) throw Error(place + "of the study, found no folder");
  if (fs::exists(target / "study.sqlite")) {
    {
      Database database(target / "study.sqlite", Database::Mode::kReadOnly, kDurable);
      if (is_empty(database)) return;
    }
    if (StudyStore(target, StudyStore::Mode::kReadOnly).study_id() == study_id) return;
    throw Error(place + "of this study, found another study; choose another folder");
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(target)) {
    // A backup that was interrupted before its first page leaves these files.
    const fs::path name = entry.path().filename();
    if (name != "recordings" && name != "writer.lock" && !is_backup_mark(name)) {
      throw Error(place + "of the study, found other files in it; choose another folder");
    }
  }
}

bool has_table(Database& database, const std::string& table) {
  Statement found(database, "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?");
  return found.bind(table).step();
}

std::set<std::string> texts_of(Database& database, const std::string& query) {
  Statement rows(database, query);
  std::set<std::string> texts;
  while (rows.step()) texts.insert(rows.text(0));
  return texts;
}

/// Every row of these in an earlier copy is one of the study's, or of somebody who withdrew.
/// The copy may be of an older layout, and is then compared by its own columns.
void require_known_rows(Database& copy, Database& study, const TableRule& rule,
                        const fs::path& target) {
  const std::string& table = rule.table;
  if (!has_table(copy, table)) return;
  std::string whole;
  for (const std::string& column :
       texts_of(copy, "SELECT name FROM pragma_table_info('" + table + "')")) {
    whole += (whole.empty() ? "quote(" : " || ',' || quote(") + column + ")";
  }
  const std::string& column = rule.erased_by;
  const std::set<std::string> known = texts_of(study, "SELECT " + whole + " FROM " + table);
  const std::set<std::string> gone =
      column.empty()
          ? std::set<std::string>()
          : texts_of(study, "SELECT " + column + " FROM withdrawal" +
                                (column == "participant"
                                     ? " UNION SELECT participant FROM withdrawal_step"
                                     : ""));
  Statement rows(
      copy, "SELECT " + whole + (column.empty() ? ", ''" : ", " + column) + " FROM " + table);
  while (rows.step()) {
    if (known.contains(rows.text(0)) || gone.contains(rows.text(1))) continue;
    throw Error(target.string() + ": expected an earlier copy of this study, found " +
                rule.row +
                " that the study does not have; nothing was changed, choose another folder");
  }
}

/// Sessions, events and tombstones are never changed, so an earlier copy holds nothing that the
/// study has not. One that does was gone on with, or is the newer of the two.
void require_earlier(Database& copy, Database& study, const fs::path& target) {
  const auto refuse = [&](std::int64_t session, const char* what) {
    throw Error(target.string() + ": expected an earlier copy of this study, found " + what +
                " of session " + std::to_string(session) +
                " that the study does not have; nothing was changed, choose another folder");
  };
  Statement known_event(
      study, "SELECT kind, time_ns, data FROM event WHERE session = ? AND sequence = ?");
  Statement known_tombstone(study, "SELECT 1 FROM withdrawal WHERE session = ?");
  Statement events(copy,
                   "SELECT session, MAX(sequence), kind, time_ns, data FROM event"
                   " GROUP BY session");
  while (events.step()) {
    const std::int64_t session = events.integer(0);
    const bool same = known_event.bind(session).bind(events.integer(1)).step() &&
                      known_event.text(0) == events.text(2) &&
                      known_event.integer(1) == events.integer(3) &&
                      known_event.text(2) == events.text(4);
    known_event.reset();
    const bool withdrew = known_tombstone.bind(session).step();
    known_tombstone.reset();
    if (!same && !withdrew) refuse(session, "events");
  }
  Statement tombstones(copy, "SELECT session FROM withdrawal");
  while (tombstones.step()) {
    const std::int64_t session = tombstones.integer(0);
    const bool known = known_tombstone.bind(session).step();
    known_tombstone.reset();
    if (!known) refuse(session, "the withdrawal");
  }
  for (const TableRule& rule : table_rules(study)) {
    if (rule.is_compared) require_known_rows(copy, study, rule, target);
  }
}

fs::path as_noted(const fs::path& target) { return fs::absolute(target).lexically_normal(); }

void note(Database& study, const fs::path& target, std::int64_t time_ns, bool forgotten) {
  Statement(study, "INSERT INTO backup (folder, time_ns, forgotten) VALUES (?, ?, ?)")
      .bind(target.string())
      .bind(time_ns)
      .bind(std::int64_t{forgotten})
      .run();
}

/// Before the copy forgets where it was exported to, the study takes these notes over. If the
/// study knows of a later export to the same place, its own note stays the last one.
void take_over_notes(const fs::path& folder, const fs::path& target) {
  const std::vector<ExportNote> known = noted_exports(folder);
  for (const ExportNote& one : noted_exports(target)) {
    const bool newer = std::ranges::any_of(known, [&](const ExportNote& other) {
      return other.place == one.place && other.time_ns >= one.time_ns;
    });
    if (!newer) note_export(folder, one);
  }
}

/// Notes this copy in the study, and the copies that were made from it. A study on a read-only
/// disk can be copied all the same.
void note_in_study(const fs::path& folder, const fs::path& target, std::int64_t time_ns,
                   BackupReport& report) try {
  std::vector<fs::path> folders = {as_noted(target)};
  if (fs::exists(target / "study.sqlite")) {
    const std::vector<fs::path> known = known_backups(folder);
    for (const fs::path& further : known_backups(target)) {
      if (std::find(known.begin(), known.end(), further) == known.end()) {
        folders.push_back(further);
      }
    }
  }
  Database study(folder / "study.sqlite", Database::Mode::kReadWrite, kDurable);
  Transaction transaction(study);
  for (const fs::path& one : folders) note(study, one, time_ns, /*forgotten=*/false);
  transaction.commit();
  if (fs::exists(target / "study.sqlite")) take_over_notes(folder, target);
} catch (const Error& error) {
  report.remarks.push_back(
      "the study does not know of this backup, so a withdrawal will not "
      "reach it: " +
      std::string(error.what()));
}

using ChunkKey = std::pair<std::int64_t, std::int64_t>;  // Segment and first tick.

std::set<ChunkKey> chunk_keys(Database& recording) {
  Statement rows(recording, "SELECT segment, first_tick FROM chunk");
  std::set<ChunkKey> keys;
  while (rows.step()) keys.emplace(rows.integer(0), rows.integer(1));
  return keys;
}

void copy_chunk(Database& from, Database& to, const ChunkKey& key) {
  Statement row(
      from, "SELECT num_samples, sha256, data FROM chunk WHERE segment = ? AND first_tick = ?");
  if (!row.bind(key.first).bind(key.second).step()) return;
  Statement(to, "INSERT INTO chunk VALUES (?, ?, ?, ?, ?)")
      .bind(key.first)
      .bind(key.second)
      .bind(row.integer(0))
      .bind(row.text(1))
      .bind_bytes(row.bytes(2))
      .run();
}

/// What a recording says of its chunks: which ticks never ran, and of which format they are.
void copy_beside_chunks(Database& from, Database& to) {
  Statement table(from,
                  "SELECT sql FROM sqlite_master WHERE type = 'table' AND name = 'missed'");
  if (table.step()) {
    if (!has_table(to, "missed")) to.execute(table.text(0));
    Statement rows(from, "SELECT segment, first_tick, num_ticks FROM missed");
    Statement insert(to, "INSERT OR IGNORE INTO missed VALUES (?, ?, ?)");
    while (rows.step()) {
      insert.bind(rows.integer(0)).bind(rows.integer(1)).bind(rows.integer(2)).run();
    }
  }
  Statement format(from, "SELECT version FROM recording_format");
  if (!format.step()) return;
  Statement(to, "UPDATE recording_format SET version = MAX(version, ?)")
      .bind(format.integer(0))
      .run();
}

/// Chunks are never changed, so those that the copy has stay as they are. Throws `Error` for a
/// recording, or a copy of it, that is of no format of this program.
void copy_recording(const fs::path& source, const fs::path& target, BackupReport& report) {
  (void)RecordingReader(source);
  if (fs::exists(target)) (void)RecordingReader(target);
  Database from(source, Database::Mode::kReadOnly, kDurable);
  if (is_empty(from)) return;
  Database to(target, fs::exists(target) ? Database::Mode::kReadWrite : Database::Mode::kCreate,
              kDurable);
  const bool is_new = is_empty(to);
  const std::set<ChunkKey> known = is_new ? std::set<ChunkKey>() : chunk_keys(to);
  if (is_new) {
    from.copy_to(to);
    report.num_chunks_copied += static_cast<std::int64_t>(chunk_keys(to).size());
  } else {
    Transaction transaction(to);
    for (const ChunkKey& key : chunk_keys(from)) {
      if (known.contains(key)) continue;
      copy_chunk(from, to, key);
      ++report.num_chunks_copied;
    }
    copy_beside_chunks(from, to);
    transaction.commit();
  }
  to.checkpoint();
  report.num_chunks += static_cast<std::int64_t>(chunk_keys(to).size());
}

/// Returns the sessions of the snapshot whose samples are kept.
std::vector<std::int64_t> sessions_in(Database& snapshot) {
  Statement rows(snapshot, "SELECT session FROM session ORDER BY session");
  std::vector<std::int64_t> sessions;
  while (rows.step()) sessions.push_back(rows.integer(0));
  return sessions;
}

/// Writes in one transaction of SQLite, so that the target holds either the earlier copy or the
/// new one.
void write_study(const Database& snapshot, const fs::path& target) {
  const fs::path file = target / "study.sqlite";
  Database to(file, fs::exists(file) ? Database::Mode::kReadWrite : Database::Mode::kCreate,
              kDurable);
  snapshot.copy_to(to);
  to.checkpoint();
}

/// Copies the recordings first and then the database that refers to them.
void copy_study(const StudyStore& study, Database& snapshot, const fs::path& target,
                const std::function<void(double)>& on_progress, BackupReport& report) {
  const std::vector<std::int64_t> sessions = sessions_in(snapshot);
  double done = 0.0;
  for (const std::int64_t session : sessions) {
    const fs::path source = study.recording_file(session);
    if (fs::exists(source)) {
      copy_recording(source, target / "recordings" / source.filename(), report);
    }
    for (const fs::path& record : flight_records(source)) {
      copy_file_durably(record, target / "recordings" / record.filename());
    }
    for (const fs::path& stream : stream_files(source)) {
      copy_stream_file(stream, target / "recordings" / stream.filename());
    }
    done += 1.0;
    if (on_progress) on_progress(done / static_cast<double>(sessions.size()));
  }
  sync_folder(target / "recordings");
  write_study(snapshot, target);
  const StudyStore copy(target, StudyStore::Mode::kReadOnly);
  for (const WithdrawalRow& withdrawn : copy.withdrawals()) {
    remove_recording(copy.recording_file(withdrawn.session));
  }
}

Integrity read_back(const fs::path& target) {
  return verify(StudyStore(target, StudyStore::Mode::kReadOnly));
}

}  // namespace

BackupReport back_up(const fs::path& folder, const fs::path& target, std::int64_t time_ns,
                     const std::function<void(double)>& on_progress) {
  bring_study_up_to_date(folder);
  const StudyStore study(folder, StudyStore::Mode::kReadOnly);
  require_own_target(folder, target, study.study_id());
  make_private_folders(target / "recordings");
  const WriterLock lock(target);

  BackupReport report;
  Database snapshot;
  {
    Database from(folder / "study.sqlite", Database::Mode::kReadOnly, kDurable);
    if (fs::exists(target / "study.sqlite")) {
      Database earlier(target / "study.sqlite", Database::Mode::kReadOnly, kDurable);
      if (!is_empty(earlier)) require_earlier(earlier, from, target);
    }
    note_in_study(folder, target, time_ns, report);
    from.copy_to(snapshot);
  }
  begin_backup(target, time_ns);
  copy_study(study, snapshot, target, on_progress, report);
  finish_backup(target, time_ns);
  report.integrity = read_back(target);
  report.on_one_disk = on_one_disk(folder, target);
  return report;
}

BackupReport restore(const fs::path& backup, const fs::path& target, std::int64_t time_ns,
                     const std::function<void(double)>& on_progress) {
  require_study(backup);
  const StudyStore study(backup, StudyStore::Mode::kReadOnly);
  if (!is_backup(backup)) {
    throw Error(backup.string() +
                ": expected a backup, found a study, in which sessions can be run; there is "
                "nothing to restore");
  }
  if (fs::exists(target / "study.sqlite") || fs::exists(target / kBackupMark)) {
    throw Error(target.string() +
                ": expected a new or empty folder for the restored study, found a study in it; "
                "nothing was changed, choose another folder");
  }
  require_own_target(backup, target, study.study_id());
  make_private_folders(target / "recordings");
  const WriterLock lock(target);
  Database snapshot;
  {
    Database from(backup / "study.sqlite", Database::Mode::kReadOnly, kDurable);
    from.copy_to(snapshot);
  }
  bring_up_to_date(snapshot);
  note(snapshot, as_noted(backup), time_ns, /*forgotten=*/false);
  // The lost study may have had a backup at this place, where the study itself is now.
  note(snapshot, as_noted(target), time_ns, /*forgotten=*/true);
  BackupReport report;
  copy_study(study, snapshot, target, on_progress, report);
  report.integrity = read_back(target);
  report.on_one_disk = on_one_disk(backup, target);
  return report;
}

std::vector<KnownBackup> dated_backups(const fs::path& folder) {
  Database database(folder / "study.sqlite", Database::Mode::kReadOnly, kDurable);
  constexpr std::int64_t kFirstThatKnowsBackups = 2;
  if (study_format_of(database) < kFirstThatKnowsBackups) return {};
  Statement rows(database,
                 "SELECT folder, time_ns FROM backup AS b WHERE NOT forgotten AND"
                 " backup = (SELECT MAX(backup) FROM backup WHERE folder = b.folder)"
                 " ORDER BY folder");
  std::vector<KnownBackup> backups;
  while (rows.step()) backups.push_back({.folder = rows.text(0), .time_ns = rows.integer(1)});
  return backups;
}

std::vector<fs::path> known_backups(const fs::path& folder) {
  std::vector<fs::path> folders;
  for (KnownBackup& backup : dated_backups(folder)) folders.push_back(std::move(backup.folder));
  return folders;
}

void forget_backup(const fs::path& folder, const fs::path& target, std::int64_t time_ns) {
  bring_study_up_to_date(folder);
  const std::vector<fs::path> known = known_backups(folder);
  if (std::find(known.begin(), known.end(), as_noted(target)) == known.end()) {
    throw Error(folder.string() + ": expected a backup in " + as_noted(target).string() +
                " to forget, found that the study knows of none there");
  }
  Database study(folder / "study.sqlite", Database::Mode::kReadWrite, kDurable);
  note(study, as_noted(target), time_ns, /*forgotten=*/true);
}

}  // namespace jnd::core
