#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/export_note.h"

namespace jnd::core {

struct WithdrawalReport {
  std::vector<std::int64_t> sessions;          ///< Deleted now or by an earlier run.
  std::vector<std::filesystem::path> backups;  ///< Known copies that were reached.
  std::vector<std::string> remaining;          ///< What could not be deleted, and why.
  std::vector<ExportNote> exports;             ///< Places that still hold some of it.
};

/// The one deletion there is: every row and recording of a participant who withdraws, in the
/// study and in every backup it knows of, overwritten and not only unlinked from the database's
/// index. A tombstone stays: the pseudonym, the session's number, how much there was. Neither
/// is given again.
///
/// Interrupted or with a backup out of reach, call it again: it finishes what remains, and
/// until then `verify` says that it is not finished. Exports and reports that hold the person
/// are named, not deleted: they lie outside of the study, perhaps in somebody's work. What
/// somebody copied by other means, and what a disk keeps of a removed file, is out of its
/// reach. Throws `Error` for a participant that the study never had. Not real time.
[[nodiscard]] WithdrawalReport withdraw(const std::filesystem::path& folder,
                                        const std::string& participant, std::int64_t time_ns);

}  // namespace jnd::core
