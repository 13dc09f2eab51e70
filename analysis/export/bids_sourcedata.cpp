#include "analysis/export/bids_sourcedata.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/storage/database.h"
#include "core/storage/recording.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

/// The triggers that prevent rows from being deleted, by name and text.
std::vector<std::pair<std::string, std::string>> guards(core::Database& database) {
  core::Statement rows(
      database,
      "SELECT name, sql FROM sqlite_master WHERE type = 'trigger' AND name LIKE "
      "'%\\_stays' ESCAPE '\\' ORDER BY name");
  std::vector<std::pair<std::string, std::string>> all;
  while (rows.step()) all.emplace_back(rows.text(0), rows.text(1));
  return all;
}

std::vector<std::string> first_column(core::Database& database, const std::string& query) {
  core::Statement rows(database, query);
  std::vector<std::string> all;
  while (rows.step()) all.push_back(rows.text(0));
  return all;
}

/// The tables with this column, in any layout of the database.
std::vector<std::string> tables_with(core::Database& database, const std::string& column) {
  return first_column(database,
                      "SELECT t.name FROM sqlite_master AS t, pragma_table_info(t.name) AS c "
                      "WHERE t.type = 'table' AND c.name = '" +
                          column + "' ORDER BY t.name");
}

std::string numbers_of(const std::vector<core::SessionRow>& sessions) {
  std::string list;
  for (const core::SessionRow& row : sessions) {
    list += (list.empty() ? "" : ", ") + std::to_string(row.session);
  }
  return "(" + list + ")";
}

void delete_rows(core::Database& database, const std::vector<core::SessionRow>& kept) {
  core::Transaction transaction(database);
  // Rows may be deleted before the rows that refer to them, because foreign keys are checked at
  // the end.
  database.execute("PRAGMA defer_foreign_keys = ON");
  const auto all_guards = guards(database);
  for (const auto& [name, sql] : all_guards) database.execute("DROP TRIGGER " + name);
  // These tables describe people outside their sessions, and places on this machine.
  std::set<std::string> emptied = {"withdrawal", "backup", "export_session", "export"};
  const std::vector<std::string> of_sessions = tables_with(database, "session");
  for (const std::string& table : tables_with(database, "participant")) {
    if (std::ranges::find(of_sessions, table) == of_sessions.end()) emptied.insert(table);
  }
  for (const std::string& table :
       first_column(database, "SELECT name FROM sqlite_master WHERE type = 'table'")) {
    if (emptied.contains(table)) database.execute("DELETE FROM " + table);
  }
  // The sessions come last, because the other rows refer to them.
  for (const std::string& table : of_sessions) {
    if (table == "session" || emptied.contains(table)) continue;
    database.execute("DELETE FROM " + table + " WHERE session NOT IN " + numbers_of(kept));
  }
  database.execute("DELETE FROM session WHERE session NOT IN " + numbers_of(kept));
  // Who has read of an adverse event, which is of no session itself.
  if (std::ranges::find(of_sessions, "acknowledgement") != of_sessions.end()) {
    database.execute(
        "DELETE FROM acknowledgement WHERE adverse_event IS NOT NULL"
        " AND adverse_event NOT IN (SELECT adverse_event FROM adverse_event)");
  }
  for (const auto& [name, sql] : all_guards) database.execute(sql);
  transaction.commit();
}

/// Moves everything into the one file, so that it can be read where nothing can be written.
void close_log(core::Database& database) {
  database.execute("PRAGMA journal_mode = DELETE");
  database.execute("VACUUM");
}

}  // namespace

void copy_study_database(const core::StudyStore& store,
                         const std::vector<core::SessionRow>& sessions,
                         const fs::path& folder) {
  core::Database study(store.folder() / "study.sqlite", core::Database::Mode::kReadOnly,
                       core::Durability::kAtClose);
  core::Database copy(folder / "study.sqlite", core::Database::Mode::kCreate,
                      core::Durability::kAtClose);
  study.copy_to(copy);
  delete_rows(copy, sessions);
  close_log(copy);
}

void copy_recording(const core::StudyStore& store, std::int64_t session,
                    const fs::path& folder) {
  const fs::path file = store.recording_file(session);
  if (!fs::exists(file)) return;
  // The recording is checked even if no task of the data set has read it.
  core::RecordingReader(file).require_intact();
  std::error_code error;
  fs::create_directories(folder / "recordings", error);
  if (error) {
    throw core::Error((folder / "recordings").string() +
                      ": expected to make this folder, found: " + error.message());
  }
  core::Database recording(file, core::Database::Mode::kReadOnly, core::Durability::kAtClose);
  core::Database copy(folder / "recordings" / file.filename(), core::Database::Mode::kCreate,
                      core::Durability::kAtClose);
  recording.copy_to(copy);
  close_log(copy);
}

}  // namespace jnd::analysis
