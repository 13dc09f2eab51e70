#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/storage/integrity.h"

namespace jnd::core {

struct BackupReport {
  std::int64_t num_chunks = 0;         ///< Chunks of all recordings in the backup.
  std::int64_t num_chunks_copied = 0;  ///< By this run; the others were there already.
  std::vector<std::string> remarks;
  bool on_one_disk = false;  ///< A disk that fails takes the study and the backup.
  Integrity integrity;       ///< What reading the backup back found.
};

/// Makes `target` a copy of the study in `folder`, or brings an earlier copy up to date: a
/// snapshot of study.sqlite first, then of each recording the chunks that are missing, then the
/// snapshot is written, in one transaction. So no event of the copy speaks of samples that it
/// does not hold, even while a session goes on, and an earlier copy stays whole if anything
/// fails: until the end a mark says that a backup was begun, so that recordings of sessions
/// which the earlier copy does not know are told from lost ones (`backup_mark.h`). The copy is
/// a study folder like any other, but marked as a copy, so that nothing is added to it
/// (`backup_mark.h`). It is noted in the study, so that a withdrawal reaches it; and it is
/// verified.
///
/// Throws `Error` for a target that holds something else, or anything that the study has not,
/// and where a disk or a right is missing. Not real time.
[[nodiscard]] BackupReport back_up(const std::filesystem::path& folder,
                                   const std::filesystem::path& target, std::int64_t time_ns,
                                   const std::function<void(double)>& on_progress = {});

/// Makes a study of a backup, in a folder that is new or empty: sessions may be run in it, and
/// the backup is a backup of it. What was interrupted goes on when it is called again. Throws
/// `Error` for a folder that holds no backup, a target that holds anything, and where a disk or
/// a right is missing. Not real time.
[[nodiscard]] BackupReport restore(const std::filesystem::path& backup,
                                   const std::filesystem::path& target, std::int64_t time_ns,
                                   const std::function<void(double)>& on_progress = {});

/// Folders that hold a copy of the study, as far as it knows.
[[nodiscard]] std::vector<std::filesystem::path> known_backups(
    const std::filesystem::path& folder);

/// A copy that the study knows of.
struct KnownBackup {
  std::filesystem::path folder;
  std::int64_t time_ns = 0;  ///< When it was begun last, since 1970-01-01 UTC.
};
/// The same with their times. One that was begun and not finished is as old as it was before:
/// see `is_unfinished_backup`.
[[nodiscard]] std::vector<KnownBackup> dated_backups(const std::filesystem::path& folder);

/// The copy in `target` exists no more: a withdrawal does not look for it. Throws `Error` if
/// the study does not know of it.
void forget_backup(const std::filesystem::path& folder, const std::filesystem::path& target,
                   std::int64_t time_ns);

}  // namespace jnd::core
