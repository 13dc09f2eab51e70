#pragma once

#include <filesystem>

namespace jnd::core {

/// Files and folders of a study: for their owner alone, and still there after a power cut. All
/// throw `Error` naming the path. Not real time.

/// Makes the folder and those above it that are missing; those made are of mode 0700.
void make_private_folders(const std::filesystem::path& folder);
/// Makes the file, empty and of mode 0600, unless it is there.
void make_private_file(const std::filesystem::path& file);
/// What was made, renamed or removed in this folder is on disk when this returns.
void sync_folder(const std::filesystem::path& folder);
/// The file's content is on disk when this returns.
void sync_file(const std::filesystem::path& file);

/// A copy of mode 0600 that is on disk when this returns, or none; one that is there is
/// replaced as a whole.
void copy_file_durably(const std::filesystem::path& source,
                       const std::filesystem::path& target);

/// Removes a recording and what lies beside it, SQLite's files, flight records and streams of
/// others, where they are.
void remove_recording(const std::filesystem::path& file);

}  // namespace jnd::core
