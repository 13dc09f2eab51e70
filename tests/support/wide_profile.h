#pragma once

#include <filesystem>
#include <string>

#include "experiments/device_profile/profile_writer.h"
#include "support/sound_profile.h"

namespace jnd::test_support {

/// Returns a profile of this device that changes nothing. Its frame is the workspace, its
/// limits are those of the loop, and every stimulus was stable. It is for tests of other things
/// on a device that can hurt somebody.
inline experiments::DeviceProfile wide_profile(const std::string& model,
                                               const std::string& serial = "") {
  experiments::DeviceProfile profile = sound_profile(model, serial);
  profile.name = "wide";
  profile.device.firmware.clear();
  profile.frame = {};
  profile.mechanics = {};
  profile.delay_s.reset();
  profile.stability->viscosity_pa_s.value = 1e6;
  profile.stability->stiffness_n_per_m = {.value = 1e6, .is_beyond_ladder = true};
  return profile;
}

/// Writes this profile into a folder for JND_PROFILE_PATH, and returns its file.
inline std::filesystem::path write_wide_profile(const std::filesystem::path& folder,
                                                const std::string& model,
                                                const std::string& serial = "") {
  return experiments::write_device_profile(wide_profile(model, serial), folder);
}

}  // namespace jnd::test_support
