#include "analysis/export/bids_sourcedata.h"

#include <string>
#include <utility>

#include "core/error.h"
#include "core/storage/database.h"
#include "core/storage/recording.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

/// The triggers that keep rows from being deleted, by name and text.
std::vector<std::pair<std::string, std::string>> guards(core::Database& database) {
  core::Statement rows(
      database,
      "SELECT name, sql FROM sqlite_master WHERE type = 'trigger' AND name LIKE "
      "'%\\_stays' ESCAPE '\\' ORDER BY name");
  std::vector<std::pair<std::string, std::string>> all;
  while (rows.step()) all.emplace_back(rows.text(0), rows.text(1));
  return all;
}

bool has_table(core::Database& database, const std::string& name) {
  core::Statement rows(database,
                       "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?");
  rows.bind(name);
  return rows.step();
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
  const auto all_guards = guards(database);
  for (const auto& [name, sql] : all_guards) database.execute("DROP TRIGGER " + name);
  for (const char* table :
       {"question_answer", "answer", "presentation", "trial", "design", "event", "session"}) {
    if (!has_table(database, table)) continue;  // Of an older layout.
    database.execute(std::string("DELETE FROM ") + table + " WHERE session NOT IN " +
                     numbers_of(kept));
  }
  for (const char* table :
       {"withdrawal", "withdrawal_step", "backup", "export_session", "export"}) {
    if (has_table(database, table)) database.execute(std::string("DELETE FROM ") + table);
  }
  for (const auto& [name, sql] : all_guards) database.execute(sql);
  transaction.commit();
}

/// Everything into the one file, so that it can be read where nothing can be written.
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
  // Also where no task of the data set has read it.
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
