#pragma once

#include <cstdint>
#include <filesystem>

namespace jnd::core {

/// A copy of a study is read, verified and analysed like any study folder, but nothing is added
/// to it: a session run in a copy is missing in the study, and the next backup would meet a
/// copy that holds more than the study does. What tells a copy from the study is a file in it,
/// backup.txt, whose words are for people; copies made before there was such a file are known
/// by the study's list of its backups, which holds the folder itself.

/// Name of the file that marks a copy.
inline constexpr const char* kBackupMark = "backup.txt";
/// Name of the file that is there while a copy is written to, and after that was interrupted.
inline constexpr const char* kUnfinishedBackupMark = "backup-unfinished.txt";

/// The folder is a copy that `back_up` made. False for a folder without a study. Not real time.
[[nodiscard]] bool is_backup(const std::filesystem::path& folder);

/// Before a copy is written to: from now on it is marked as a copy, one that is being brought
/// up to date. On disk when this returns. Throws `Error`. Not real time.
void begin_backup(const std::filesystem::path& folder, std::int64_t time_ns);
/// It is up to date: the mark has its date, and nothing says any more that a backup was begun.
void finish_backup(const std::filesystem::path& folder, std::int64_t time_ns);
/// A backup was begun and not finished: what is in the folder is the earlier copy, whole, with
/// some of what is newer beside it, or the newer one. Not real time.
[[nodiscard]] bool is_unfinished_backup(const std::filesystem::path& folder);
/// Whether a file of this name is one of the marks.
[[nodiscard]] bool is_backup_mark(const std::filesystem::path& name);

/// Throws `Error`, which says how to go on, for a folder that is a copy. Not real time.
void require_no_backup(const std::filesystem::path& folder);

/// Both lie on one file system, so that a disk that fails takes both. False where that cannot
/// be told. Not real time.
[[nodiscard]] bool on_one_disk(const std::filesystem::path& folder,
                               const std::filesystem::path& other);

}  // namespace jnd::core
