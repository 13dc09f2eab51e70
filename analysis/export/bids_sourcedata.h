#pragma once

#include <filesystem>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// Copies the study's database into `folder`/study.sqlite with only the rows of these sessions.
/// It has no unrequested pilots, no records of people who withdrew, no folders of backups or
/// exports, and no freed pages. It is a single file that needs no other one. The same study
/// gives the same bytes. Throws `Error`.
void copy_study_database(const core::StudyStore& store,
                         const std::vector<core::SessionRow>& sessions,
                         const std::filesystem::path& folder);

/// Copies a session's recording, if there is one, into `folder`/recordings.
void copy_recording(const core::StudyStore& store, std::int64_t session,
                    const std::filesystem::path& folder);

}  // namespace jnd::analysis
