#pragma once

#include <filesystem>

namespace jnd::core {

/// Files and folders of a study. They are readable by their owner alone, and survive a power
/// cut. All functions throw `Error` naming the path. Not real time.

/// Makes the folder and its missing parents. New folders have the mode 0700.
void make_private_folders(const std::filesystem::path& folder);
/// Makes the file, empty and of mode 0600, unless it exists.
void make_private_file(const std::filesystem::path& file);
/// Returns once everything that was made, renamed or removed in this folder is on disk.
void sync_folder(const std::filesystem::path& folder);
/// Returns once the file's content is on disk.
void sync_file(const std::filesystem::path& file);

/// Makes a copy of mode 0600 that is on disk when the function returns, or none. An existing
/// target is replaced as a whole.
void copy_file_durably(const std::filesystem::path& source,
                       const std::filesystem::path& target);

/// Removes a recording and what lies beside it: SQLite's files, flight records and streams of
/// other recorders.
void remove_recording(const std::filesystem::path& file);

}  // namespace jnd::core
