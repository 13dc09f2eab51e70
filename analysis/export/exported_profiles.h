#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What was measured of the devices of these sessions, each once.
[[nodiscard]] std::vector<core::DeviceProfileRow> exported_profiles(
    const core::StudyStore& store, const std::vector<core::SessionRow>& sessions);

/// The file of a profile in the folder `device_profiles` of a data set: its hash, so that
/// `device_profile_sha256` names it.
[[nodiscard]] std::string profile_file_name(const core::DeviceProfileRow& profile);

}  // namespace jnd::analysis
