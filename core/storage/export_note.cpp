#include "core/storage/export_note.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "core/storage/database.h"
#include "core/storage/study_format.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFirstThatKnowsExports = 6;

fs::path noted_place(const fs::path& place) {
  std::error_code error;
  fs::path whole = fs::weakly_canonical(fs::absolute(place), error);
  if (error) whole = fs::absolute(place).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

std::vector<std::int64_t> sessions_of(Database& database, std::int64_t number) {
  Statement rows(database,
                 "SELECT session FROM export_session WHERE export = ? ORDER BY session");
  rows.bind(number);
  std::vector<std::int64_t> sessions;
  while (rows.step()) sessions.push_back(rows.integer(0));
  return sessions;
}

bool holds_any(const ExportNote& note, const std::vector<std::int64_t>& sessions) {
  return std::ranges::any_of(note.sessions, [&](std::int64_t session) {
    return std::ranges::find(sessions, session) != sessions.end();
  });
}

/// Returns the files NAME.unfinished-XXXXXX beside the place, which exports that were killed
/// left.
std::vector<fs::path> left_beside(const fs::path& place) {
  const std::string start = place.filename().string() + ".unfinished-";
  std::vector<fs::path> left;
  std::error_code error;
  for (fs::directory_iterator entry(place.parent_path(), error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().filename().string().starts_with(start)) left.push_back(entry->path());
  }
  std::ranges::sort(left);
  return left;
}

}  // namespace

bool is_free_place(const fs::path& place) {
  std::error_code error;
  const fs::file_status status = fs::status(place, error);
  if (status.type() == fs::file_type::not_found) return true;
  return !error && fs::is_directory(status) && fs::is_empty(place, error) && !error;
}

void note_export(const fs::path& folder, const ExportNote& note) {
  bring_study_up_to_date(folder);
  Database study(folder / "study.sqlite", Database::Mode::kReadWrite, Durability::kEveryCommit);
  Transaction transaction(study);
  Statement(study, "INSERT INTO export (place, kind, time_ns) VALUES (?, ?, ?)")
      .bind(noted_place(note.place).string())
      .bind(note.kind)
      .bind(note.time_ns)
      .run();
  for (const std::int64_t session : note.sessions) {
    Statement(study, "INSERT INTO export_session SELECT MAX(export), ? FROM export")
        .bind(session)
        .run();
  }
  transaction.commit();
}

std::vector<ExportNote> noted_exports(const fs::path& folder) {
  Database database(folder / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  if (study_format_of(database) < kFirstThatKnowsExports) return {};
  Statement rows(database, "SELECT export, place, kind, time_ns FROM export ORDER BY export");
  std::vector<ExportNote> notes;
  while (rows.step()) {
    notes.push_back({.place = rows.text(1),
                     .kind = rows.text(2),
                     .time_ns = rows.integer(3),
                     .sessions = sessions_of(database, rows.integer(0))});
  }
  return notes;
}

std::vector<ExportNote> exports_still_there(const std::vector<ExportNote>& notes,
                                            const std::vector<std::int64_t>& sessions) {
  std::map<fs::path, ExportNote> last, last_holding;
  for (const ExportNote& note : notes) {
    last[note.place] = note;
    if (holds_any(note, sessions)) last_holding[note.place] = note;
  }
  std::vector<ExportNote> there;
  for (const auto& [place, note] : last_holding) {
    if (holds_any(last.at(place), sessions) && !is_free_place(place)) there.push_back(note);
    // It is unknown which of the exports to this place left it.
    for (fs::path& left : left_beside(place)) {
      there.push_back(note);
      there.back().place = std::move(left);
    }
  }
  return there;
}

}  // namespace jnd::core
