#pragma once

#include <filesystem>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// Copies the study's database into `folder`/study.sqlite, with the rows of these sessions
/// alone: no pilot that was not asked for, no tombstone of who withdrew, no folder of a backup
/// or an export; freed pages are gone. One file that needs no other beside it. The same study
/// gives the same bytes. Throws `Error`.
void copy_study_database(const core::StudyStore& store,
                         const std::vector<core::SessionRow>& sessions,
                         const std::filesystem::path& folder);

/// Copies a session's recording, if there is one, into `folder`/recordings.
void copy_recording(const core::StudyStore& store, std::int64_t session,
                    const std::filesystem::path& folder);

}  // namespace jnd::analysis
