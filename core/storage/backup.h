#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/storage/integrity.h"

namespace jnd::core {

struct BackupReport {
  std::int64_t num_chunks = 0;  ///< Chunks of all recordings in the backup.
  /// Chunks that this run copied; the others were there already.
  std::int64_t num_chunks_copied = 0;
  std::vector<std::string> remarks;
  /// The study and the backup are on the same disk, which takes both if it fails.
  bool on_one_disk = false;
  Integrity integrity;  ///< Result of reading the backup back.
};

/// Makes `target` a copy of the study in `folder`, or brings an earlier copy up to date. It
/// takes a snapshot of study.sqlite first, then copies the missing chunks of each recording,
/// then writes the snapshot in one transaction. So no event of the copy refers to samples that
/// it lacks, even while a session goes on, and an earlier copy stays whole if anything fails.
/// Until the end a mark says that a backup was begun, so that recordings of sessions which the
/// earlier copy does not know are not taken for lost ones (`backup_mark.h`). The copy is a
/// study folder like any other, but is marked as a copy, so that nothing is added to it. The
/// study notes the copy, so that a withdrawal reaches it. The copy is verified at the end.
///
/// Throws `Error` for a target that holds something else or anything that the study lacks, and
/// if a disk or a right is missing. Not real time.
[[nodiscard]] BackupReport back_up(const std::filesystem::path& folder,
                                   const std::filesystem::path& target, std::int64_t time_ns,
                                   const std::function<void(double)>& on_progress = {});

/// Makes a study from a backup, in a folder that is new or empty. Sessions may be run in it,
/// and the backup becomes a backup of it. If the function was interrupted, call it again to
/// continue. Throws `Error` for a folder that holds no backup, for a target that holds
/// anything, and if a disk or a right is missing. Not real time.
[[nodiscard]] BackupReport restore(const std::filesystem::path& backup,
                                   const std::filesystem::path& target, std::int64_t time_ns,
                                   const std::function<void(double)>& on_progress = {});

/// Returns the folders that hold a copy of the study, as far as it knows.
[[nodiscard]] std::vector<std::filesystem::path> known_backups(
    const std::filesystem::path& folder);

/// A copy of which the study knows.
struct KnownBackup {
  std::filesystem::path folder;
  std::int64_t time_ns = 0;  ///< Start of the last backup to it, since 1970-01-01 UTC.
};
/// Returns the known copies with their times. A backup that was begun and not finished does not
/// change the time; see `is_unfinished_backup`.
[[nodiscard]] std::vector<KnownBackup> dated_backups(const std::filesystem::path& folder);

/// Notes that the copy in `target` exists no more, so that a withdrawal does not look for it.
/// Throws `Error` if the study does not know of it.
void forget_backup(const std::filesystem::path& folder, const std::filesystem::path& target,
                   std::int64_t time_ns);

}  // namespace jnd::core
