#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace jnd::core {

/// Notes that somebody exported sessions of a study to a place. A withdrawal does not reach
/// that place, so the study remembers it.
struct ExportNote {
  std::filesystem::path place;  ///< Absolute path with links resolved.
  std::string kind;             ///< "csv", "bids", "hdf5", "report"
  std::int64_t time_ns = 0;
  std::vector<std::int64_t> sessions;
};

/// Whether the place does not exist or is an empty folder, as exports require.
[[nodiscard]] bool is_free_place(const std::filesystem::path& place);

/// Notes what is about to be written to a free place. So the note is there even if the program
/// dies during the export. A study of an older layout is brought up to date. Throws `Error`,
/// also for a study that cannot be written to. Not real time.
void note_export(const std::filesystem::path& folder, const ExportNote& note);

/// Returns all notes that the folder (a study or a backup) has, in the order in which they were
/// written. Throws `Error`. Not real time.
[[nodiscard]] std::vector<ExportNote> noted_exports(const std::filesystem::path& folder);

/// Returns the places that still hold something of these sessions. These are the places that
/// exist and whose last note has one of the sessions, and the remains of interrupted exports
/// beside a place of which any note has one. A place that cannot be inspected counts as one
/// that holds something. Not real time.
[[nodiscard]] std::vector<ExportNote> exports_still_there(
    const std::vector<ExportNote>& notes, const std::vector<std::int64_t>& sessions);

}  // namespace jnd::core
