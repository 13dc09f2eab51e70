#pragma once

#include <cstdint>
#include <filesystem>

#include "core/storage/database.h"

namespace jnd::core {

/// The layout of study.sqlite. Every version of the program brings older layouts up to its own:
/// step n of data/database/ leads from layout n - 1 to n, in one transaction.

/// The layout that this program writes and reads.
[[nodiscard]] std::int64_t current_study_format() noexcept;

/// Returns the layout of the database, or 0 for an empty one. Throws `Error` for a database
/// that belongs to no study or to a newer program.
[[nodiscard]] std::int64_t study_format_of(Database& database);

/// Throws `Error` unless the folder holds a study of this layout or an older one. It changes
/// nothing, whereas opening a foreign database for writing already would.
void require_study(const std::filesystem::path& folder);

/// Carries out the missing steps.
void bring_up_to_date(Database& database);

/// Does the same for the study in a folder, and writes to it only if a step is missing. Throws
/// `Error`, also if another program writes to the study.
void bring_study_up_to_date(const std::filesystem::path& folder);

}  // namespace jnd::core
