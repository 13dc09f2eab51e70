#include "analysis/export/exported_profiles.h"

#include <set>

namespace jnd::analysis {

std::vector<core::DeviceProfileRow> exported_profiles(
    const core::StudyStore& store, const std::vector<core::SessionRow>& sessions) {
  std::vector<core::DeviceProfileRow> profiles;
  std::set<std::string> hashes = {""};
  for (const core::SessionRow& row : sessions) {
    if (!hashes.insert(row.device_profile_sha256).second) continue;
    profiles.push_back(store.device_profile(row.device_profile_sha256));
  }
  return profiles;
}

std::string profile_file_name(const core::DeviceProfileRow& profile) {
  return profile.sha256 + ".device.json";
}

}  // namespace jnd::analysis
