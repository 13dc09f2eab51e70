#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace jnd::core {

/// What somebody wrote of a study to a place of its own, and which sessions are in it. A
/// withdrawal does not reach it, so the study remembers it.
struct ExportNote {
  std::filesystem::path place;  ///< Absolute, links followed.
  std::string kind;             ///< "csv", "bids", "hdf5", "report"
  std::int64_t time_ns = 0;
  std::vector<std::int64_t> sessions;
};

/// Whether nothing is there but perhaps an empty folder: what exports are written to.
[[nodiscard]] bool is_free_place(const std::filesystem::path& place);

/// Remembers what is about to be written to a free place, so that a program which dies
/// meanwhile has told. A study of an older layout is brought up to date. Throws `Error`, also
/// for a study that cannot be written to. Not real time.
void note_export(const std::filesystem::path& folder, const ExportNote& note);

/// All notes, as far as the folder (a study or a backup) knows, the last one written last.
/// Throws `Error`. Not real time.
[[nodiscard]] std::vector<ExportNote> noted_exports(const std::filesystem::path& folder);

/// Places that still hold something of these sessions: those whose last note has one of them
/// and where something is, and what an interrupted export left beside a place that any note has
/// them in. A place that cannot be looked at counts as one that holds something. Not real time.
[[nodiscard]] std::vector<ExportNote> exports_still_there(
    const std::vector<ExportNote>& notes, const std::vector<std::int64_t>& sessions);

}  // namespace jnd::core
