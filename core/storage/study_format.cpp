#include "core/storage/study_format.h"

#include <iterator>
#include <string>

#include "core/error.h"
#include "core/storage/study_schema.h"
#include "core/storage/writer_lock.h"

namespace jnd::core {
namespace {

constexpr std::int64_t kApplicationId = 0x6a6e6431;  // "jnd1", the same for every layout.

}  // namespace

std::int64_t current_study_format() noexcept { return std::ssize(kStudySchemaSteps); }

std::int64_t study_format_of(Database& database) {
  if (is_empty(database)) return 0;
  const std::string place = database.file().string() + ": expected ";
  Statement application(database, "PRAGMA application_id");
  if (!application.step() || application.integer(0) != kApplicationId) {
    throw Error(place + "a study of jnd, found another kind of database");
  }
  Statement format(database, "SELECT MAX(version) FROM study_format");
  if (!format.step() || format.integer(0) < 1) {
    throw Error(place + "the number of its layout, found none");
  }
  if (format.integer(0) > current_study_format()) {
    throw Error(place + "layout " + std::to_string(current_study_format()) +
                " or older, found " + std::to_string(format.integer(0)) +
                "; open it with a newer jnd");
  }
  return format.integer(0);
}

void require_study(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "study.sqlite";
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw Error(folder.string() + ": expected a study folder of jnd, found " +
                (error ? error.message() : "no study.sqlite in it"));
  }
  Database database(file, Database::Mode::kReadOnly, Durability::kEveryCommit);
  (void)study_format_of(database);
}

void bring_up_to_date(Database& database) {
  for (std::int64_t format = study_format_of(database); format < current_study_format();
       ++format) {
    Transaction step(database);
    database.execute(kStudySchemaSteps[format]);
    database.execute("INSERT INTO study_format VALUES (" + std::to_string(format + 1) +
                     ", 'jnd')");
    database.execute("PRAGMA application_id = " + std::to_string(kApplicationId));
    step.commit();
  }
}

void bring_study_up_to_date(const std::filesystem::path& folder) {
  require_study(folder);
  bool outdated = false;
  {
    Database database(folder / "study.sqlite", Database::Mode::kReadOnly,
                      Durability::kEveryCommit);
    outdated = study_format_of(database) < current_study_format();
  }
  if (!outdated) return;
  const WriterLock lock(folder);
  Database database(folder / "study.sqlite", Database::Mode::kReadWrite,
                    Durability::kEveryCommit);
  bring_up_to_date(database);
}

}  // namespace jnd::core
