#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace jnd::core {

/// What somebody has read: a note, given by its event in the log of a session, or an adverse
/// event.
struct ReadNote {
  std::int64_t session = 0, sequence = 0;  ///< Of the note; 0 and 0 for an adverse event.
  std::int64_t adverse_event = 0;          ///< Number of the adverse event; 0 for a note.

  friend bool operator==(const ReadNote&, const ReadNote&) = default;
};
struct Acknowledgement {
  ReadNote what;
  std::int64_t time_ns = 0;  ///< Since 1970-01-01 UTC.
};

/// Writes down that somebody has read it, unless that was written down before. It is on disk
/// when the function returns. A study of an older layout is brought up to date. Throws `Error`
/// for a note that does not exist, if another program writes to the study, and for a backup.
/// Not real time.
void acknowledge(const std::filesystem::path& folder, const ReadNote& what,
                 std::int64_t time_ns);
/// Returns them in the order in which they were written. Not real time.
[[nodiscard]] std::vector<Acknowledgement> acknowledgements(
    const std::filesystem::path& folder);

}  // namespace jnd::core
