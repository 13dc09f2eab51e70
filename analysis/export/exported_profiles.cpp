#include "analysis/export/exported_profiles.h"

#include <set>

#include "core/storage/sha256.h"

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

std::vector<ExportedLaboratory> exported_laboratories(
    const std::vector<core::SessionRow>& sessions) {
  std::vector<ExportedLaboratory> laboratories;
  std::set<std::string> texts = {""};
  for (const core::SessionRow& row : sessions) {
    if (!texts.insert(row.laboratory).second) continue;
    laboratories.push_back({.sha256 = core::sha256(row.laboratory), .text = row.laboratory});
  }
  return laboratories;
}

std::string profile_file_name(const core::DeviceProfileRow& profile) {
  return profile.sha256 + ".device.json";
}

}  // namespace jnd::analysis
