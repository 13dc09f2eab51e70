#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What was measured of the devices of these sessions, each once.
[[nodiscard]] std::vector<core::DeviceProfileRow> exported_profiles(
    const core::StudyStore& store, const std::vector<core::SessionRow>& sessions);

/// A laboratory of simulated participants.
struct ExportedLaboratory {
  std::string sha256;  ///< As `laboratory_sha256` of a session has it.
  std::string text;    ///< JSON, word for word.

  /// Its file in the folder `laboratories` of a data set.
  [[nodiscard]] std::string file_name() const { return sha256 + ".json"; }
};
/// Those of these sessions, each once.
[[nodiscard]] std::vector<ExportedLaboratory> exported_laboratories(
    const std::vector<core::SessionRow>& sessions);

/// The file of a profile in the folder `device_profiles` of a data set: its hash, so that
/// `device_profile_sha256` names it.
[[nodiscard]] std::string profile_file_name(const core::DeviceProfileRow& profile);

}  // namespace jnd::analysis
