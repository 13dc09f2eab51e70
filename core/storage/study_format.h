#pragma once

#include <cstdint>
#include <filesystem>

#include "core/storage/database.h"

namespace jnd::core {

/// The layout of study.sqlite, which every version of the program brings up to its own: step n
/// of data/database/ leads from layout n - 1 to n, in one transaction.

/// The layout that this program writes and reads.
[[nodiscard]] std::int64_t current_study_format() noexcept;

/// The layout of the database, 0 for an empty one. Throws `Error` for a database that is none
/// of a study, or of a newer program.
[[nodiscard]] std::int64_t study_format_of(Database& database);

/// Throws `Error` unless the folder holds a study of this layout or an older one; changes
/// nothing, as opening a foreign database to write already would.
void require_study(const std::filesystem::path& folder);

/// Carries out the steps that are missing.
void bring_up_to_date(Database& database);

/// The same for the study in a folder, which is written to only where a step is missing. Throws
/// `Error`, also where another program writes to it.
void bring_study_up_to_date(const std::filesystem::path& folder);

}  // namespace jnd::core
