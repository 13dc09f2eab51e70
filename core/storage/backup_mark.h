#pragma once

#include <cstdint>
#include <filesystem>

namespace jnd::core {

/// A copy of a study is read, verified and analysed like any study folder, but nothing is added
/// to it. A session that is run in a copy would be missing in the study, and the next backup
/// would find more in the copy than in the study. A copy has a file, backup.txt, whose words
/// are for people. Copies that are older than this file are recognised by the study's list of
/// its backups, which contains the folder itself.

/// Name of the file that marks a copy.
inline constexpr const char* kBackupMark = "backup.txt";
/// Name of the file that exists while a copy is being written, and after that was interrupted.
inline constexpr const char* kUnfinishedBackupMark = "backup-unfinished.txt";

/// Whether the folder is a copy that `back_up` made. False for a folder without a study. Not
/// real time.
[[nodiscard]] bool is_backup(const std::filesystem::path& folder);

/// Marks the folder as a copy that is being brought up to date. Call it before writing to the
/// copy. The mark is on disk when the function returns. Throws `Error`. Not real time.
void begin_backup(const std::filesystem::path& folder, std::int64_t time_ns);
/// Marks the copy as up to date: the mark gets its date, and the note of an unfinished backup
/// is removed.
void finish_backup(const std::filesystem::path& folder, std::int64_t time_ns);
/// Whether a backup was begun and not finished. The folder then holds the whole earlier copy,
/// perhaps with some newer data beside it, or the newer copy. Not real time.
[[nodiscard]] bool is_unfinished_backup(const std::filesystem::path& folder);
/// Whether a file of this name is one of the marks.
[[nodiscard]] bool is_backup_mark(const std::filesystem::path& name);

/// Throws `Error` for a folder that is a copy; the message says how to go on. Not real time.
void require_no_backup(const std::filesystem::path& folder);

/// Whether both lie on one file system, so that a failing disk takes both. False if that cannot
/// be told. Not real time.
[[nodiscard]] bool on_one_disk(const std::filesystem::path& folder,
                               const std::filesystem::path& other);

}  // namespace jnd::core
