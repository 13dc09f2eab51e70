#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/export_note.h"

namespace jnd::core {

struct WithdrawalReport {
  std::vector<std::int64_t> sessions;          ///< Sessions deleted now or by an earlier run.
  std::vector<std::filesystem::path> backups;  ///< Known copies that were reached.
  std::vector<std::string> remaining;          ///< What could not be deleted, and why.
  /// Places that still hold some of the person's data.
  std::vector<ExportNote> exports;
};

/// Deletes every row and recording of a participant who withdraws, in the study and in every
/// backup that it knows. It is the only deletion there is. The data are overwritten and not
/// merely unlinked from the database's index. A tombstone stays: the pseudonym, the session's
/// number, and how much data there was. Neither pseudonym nor number is given again.
///
/// If it was interrupted or a backup is out of reach, call it again to finish what remains;
/// until then `verify` reports that it is unfinished. Exports and reports that contain the
/// person are named but not deleted, because they lie outside of the study. It cannot reach
/// what somebody copied by other means, or what a disk keeps of a removed file. Throws `Error`
/// for a participant whom the study never had. Not real time.
[[nodiscard]] WithdrawalReport withdraw(const std::filesystem::path& folder,
                                        const std::string& participant, std::int64_t time_ns);

}  // namespace jnd::core
