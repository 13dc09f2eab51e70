#include "core/storage/backup_mark.h"

#include <sys/stat.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <string>
#include <system_error>

#include "core/error.h"
#include "core/storage/backup.h"
#include "core/storage/files.h"

namespace jnd::core {
namespace {

namespace fs = std::filesystem;

std::string day_of(std::int64_t time_ns) {
  const std::time_t seconds = time_ns / 1'000'000'000;
  std::tm parts{};
  ::gmtime_r(&seconds, &parts);
  char text[sizeof "2026-11-23 16:05 UTC"] = "";
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

bool is_marked(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / kBackupMark, error);
}

constexpr const char* kUnfinishedEnding = ".unfinished";

/// Writes the file as a whole or not at all. It is on disk when the function returns.
void write_mark(const fs::path& file, const std::string& words) {
  const fs::path unfinished = file.string() + kUnfinishedEnding;
  make_private_file(unfinished);
  std::ofstream stream(unfinished, std::ios::trunc);
  stream << words;
  stream.close();
  std::error_code error;
  if (!stream) error = std::make_error_code(std::errc::no_space_on_device);
  if (!error) sync_file(unfinished);
  if (!error) fs::rename(unfinished, file, error);
  if (error) {
    throw Error(file.string() + ": expected to write this file, found: " + error.message());
  }
  sync_folder(file.parent_path());
}

std::string words_of_backup(const std::string& date) {
  return "This folder is a backup of a study of jnd" + date +
         ".\nSessions are run in the study itself. Where the study is lost, this makes a study "
         "of the backup:\n\n    jnd restore THIS_FOLDER --to NEW_FOLDER\n";
}

/// Whether the study lists this folder as one of its own backups.
bool lists_itself(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / "study.sqlite", error)) return false;
  return std::ranges::any_of(known_backups(folder), [&](const fs::path& known) {
    std::error_code ignored;
    return fs::equivalent(known, folder, ignored);
  });
}

}  // namespace

bool is_backup(const fs::path& folder) { return is_marked(folder) || lists_itself(folder); }

void begin_backup(const fs::path& folder, std::int64_t time_ns) {
  write_mark(
      folder / kUnfinishedBackupMark,
      "A backup to this folder was begun on " + day_of(time_ns) +
          " and is not finished.\nIf no jnd is at work on it, it was interrupted: what was "
          "here before is whole. Run it again.\n");
  if (!is_marked(folder)) write_mark(folder / kBackupMark, words_of_backup(""));
}

void finish_backup(const fs::path& folder, std::int64_t time_ns) {
  write_mark(folder / kBackupMark,
             words_of_backup(", last brought up to date on " + day_of(time_ns)));
  std::error_code error;
  fs::remove(folder / kUnfinishedBackupMark, error);
  if (error) {
    throw Error((folder / kUnfinishedBackupMark).string() +
                ": expected to remove this file, found: " + error.message());
  }
  sync_folder(folder);
}

bool is_unfinished_backup(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / kUnfinishedBackupMark, error);
}

bool is_backup_mark(const fs::path& name) {
  const auto is = [&](const std::string& mark) {
    return name == mark || name == mark + kUnfinishedEnding;
  };
  return is(kBackupMark) || is(kUnfinishedBackupMark);
}

void require_no_backup(const fs::path& folder) {
  const std::string found = folder.string() + ": expected the study itself, found ";
  const std::string restore = "`jnd restore " + folder.string() + " --to NEW_FOLDER`";
  if (is_marked(folder)) {
    throw Error(
        found +
        "a backup of it, to which nothing is added; go on in the study, or where that is "
        "lost make a study of the backup with " +
        restore);
  }
  if (lists_itself(folder)) {
    throw Error(found +
                "a folder that the study knows as its backup, to which nothing is added; go on "
                "in the study, or where that is lost make a study of the backup with " +
                restore + "; if this is the study itself, which was moved here, say so with " +
                "`jnd backup " + folder.string() + " --forget " + folder.string() + "`");
  }
}

bool on_one_disk(const fs::path& folder, const fs::path& other) {
  struct stat one {
  }, two{};
  return ::stat(folder.c_str(), &one) == 0 && ::stat(other.c_str(), &two) == 0 &&
         one.st_dev == two.st_dev;
}

}  // namespace jnd::core
