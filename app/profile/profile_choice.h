#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/profile/known_profile.h"
#include "core/storage/study_store.h"
#include "device/haptic_device.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// Where profiles are looked for: the folders of JND_PROFILE_PATH (colons between), then
/// `devices` in the user's XDG_CONFIG_HOME/jnd, else in ~/.config/jnd.
[[nodiscard]] std::vector<std::filesystem::path> profile_folders();

/// Where a profile is written: the folder that is given, else where sessions look for it; of a
/// simulated device, which needs none, beside the record of its measurements.
[[nodiscard]] std::filesystem::path folder_for_profile(const std::filesystem::path& given,
                                                       const std::filesystem::path& record,
                                                       bool is_simulated);

/// What is known of a device before it is open.
struct DeviceOfProfile {
  std::string name;  ///< As after `--device`, for messages.
  device::DeviceIdentity identity;
  bool is_simulated = false;
};

/// Asks the device without opening it. Throws as `device::make_device`.
[[nodiscard]] DeviceOfProfile device_of_profile(const std::string& name, double rate_hz);

/// What the folders have for a device.
struct FoundProfile {
  /// The one measured last, then the one checked last; of the same day, most often.
  std::optional<KnownProfile> known;
  std::string problem;  ///< Why it is not to be used, a sentence; "" if it is.
  /// Others that fit, files that cannot be read: sentences.
  std::vector<std::string> remarks;
};
[[nodiscard]] FoundProfile find_profile(const DeviceOfProfile& device,
                                        const std::vector<std::filesystem::path>& folders,
                                        const std::string& on_day);

/// What a session on this device is to use.
struct ProfileChoice {
  std::optional<KnownProfile> known;
  std::string lack;  ///< Of a real device: why there is none, a sentence.
  std::vector<std::string> remarks;
};

/// `file`: as `--profile` says, which has to fit and be valid: throws `experiments::
/// ProtocolError` for one that is broken or edited, and `core::Error` for one that is foreign
/// or has ended; "": a real device's own is looked for, and a simulated one has none.
[[nodiscard]] ProfileChoice choose_profile(const DeviceOfProfile& device,
                                           const std::string& file,
                                           const std::vector<std::filesystem::path>& folders,
                                           const std::string& on_day);

/// The profile that a daily check of the device is about: this file, or the one that is found,
/// also for a simulated device. Its last check may have failed. Throws as `choose_profile`, and
/// `core::Error` where there is none.
[[nodiscard]] KnownProfile profile_to_check(const DeviceOfProfile& device,
                                            const std::string& file,
                                            const std::vector<std::filesystem::path>& folders,
                                            const std::string& on_day);

/// Whether anything in the study is to be felt: a medium that is not free space, or a wall.
[[nodiscard]] bool asks_for_force(const experiments::Study& study);

/// Why a session of this study must not be begun, a sentence; "" if it may: a real device
/// without a valid profile runs what asks for no force.
[[nodiscard]] std::string refused_words(const DeviceOfProfile& device,
                                        const ProfileChoice& choice,
                                        const experiments::Study& study);

/// Why this session must not be gone on with, likewise: its device says another model or
/// serial, what was measured is another by now, or it has ended. `file` as in `choose_profile`;
/// where no file is found any more, what the session keeps counts.
[[nodiscard]] std::string refused_resume_words(
    const core::StudyStore& store, const core::SessionRow& session,
    const experiments::Study& study, const DeviceOfProfile& device, const std::string& file,
    const std::vector<std::filesystem::path>& folders, const std::string& on_day);

}  // namespace jnd::app
