#include "core/storage/acknowledgement.h"

#include <algorithm>

#include "core/storage/backup_mark.h"
#include "core/storage/database.h"
#include "core/storage/study_format.h"
#include "core/storage/writer_lock.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFirstThatKnowsReaders = 13;

std::vector<Acknowledgement> written_acknowledgements(Database& database) {
  Statement rows(database,
                 "SELECT session, sequence, adverse_event, time_ns FROM acknowledgement"
                 " ORDER BY entry");
  std::vector<Acknowledgement> all;
  while (rows.step()) {
    all.push_back({.what = {.session = rows.optional_integer(0).value_or(0),
                            .sequence = rows.optional_integer(1).value_or(0),
                            .adverse_event = rows.optional_integer(2).value_or(0)},
                   .time_ns = rows.integer(3)});
  }
  return all;
}

bool is_there(Database& database, const ReadNote& what) {
  if (what.adverse_event != 0) {
    return Statement(database, "SELECT 1 FROM adverse_event WHERE adverse_event = ?")
        .bind(what.adverse_event)
        .step();
  }
  return Statement(database, "SELECT 1 FROM event WHERE session = ? AND sequence = ?")
      .bind(what.session)
      .bind(what.sequence)
      .step();
}

std::optional<std::int64_t> unless_zero(std::int64_t value) {
  return value == 0 ? std::nullopt : std::optional(value);
}

}  // namespace

void acknowledge(const fs::path& folder, const ReadNote& what, std::int64_t time_ns) {
  require_study(folder);
  require_no_backup(folder);
  const WriterLock lock(folder);
  Database database(folder / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  bring_up_to_date(database);
  if (!is_there(database, what)) {
    throw Error(folder.string() +
                ": expected a note to acknowledge, found none of that number");
  }
  const std::vector<Acknowledgement> known = written_acknowledgements(database);
  if (std::ranges::find(known, what, &Acknowledgement::what) != known.end()) return;
  Statement(database,
            "INSERT INTO acknowledgement (session, sequence, adverse_event, time_ns)"
            " VALUES (?, ?, ?, ?)")
      .bind(unless_zero(what.session))
      .bind(unless_zero(what.sequence))
      .bind(unless_zero(what.adverse_event))
      .bind(time_ns)
      .run();
}

std::vector<Acknowledgement> acknowledgements(const fs::path& folder) {
  Database database(folder / "study.sqlite", Database::Mode::kReadOnly,
                    Durability::kEveryCommit);
  if (study_format_of(database) < kFirstThatKnowsReaders) return {};
  return written_acknowledgements(database);
}

}  // namespace jnd::core
