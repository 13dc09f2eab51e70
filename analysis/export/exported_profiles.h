#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// The profiles of the devices of these sessions, each once.
[[nodiscard]] std::vector<core::DeviceProfileRow> exported_profiles(
    const core::StudyStore& store, const std::vector<core::SessionRow>& sessions);

/// A laboratory of simulated participants.
struct ExportedLaboratory {
  std::string sha256;  ///< The `laboratory_sha256` of a session.
  std::string text;    ///< The unchanged JSON text.

  /// The name of its file in the folder `laboratories` of a data set.
  [[nodiscard]] std::string file_name() const { return sha256 + ".json"; }
};
/// The laboratories of these sessions, each once.
[[nodiscard]] std::vector<ExportedLaboratory> exported_laboratories(
    const std::vector<core::SessionRow>& sessions);

/// The name of a profile's file in the folder `device_profiles` of a data set. It is the
/// profile's hash, to which `device_profile_sha256` refers.
[[nodiscard]] std::string profile_file_name(const core::DeviceProfileRow& profile);

}  // namespace jnd::analysis
