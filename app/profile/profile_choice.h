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

/// The folders where profiles are looked for: those of JND_PROFILE_PATH, separated by colons,
/// then `devices` in the user's XDG_CONFIG_HOME/jnd, or else in ~/.config/jnd.
[[nodiscard]] std::vector<std::filesystem::path> profile_folders();

/// The folder where a profile is written: the given one, or else where sessions look for
/// profiles. A simulated device needs no profile, so its profile is written beside the record
/// of its measurements.
[[nodiscard]] std::filesystem::path folder_for_profile(const std::filesystem::path& given,
                                                       const std::filesystem::path& record,
                                                       bool is_simulated);

/// What is known about a device before it is open.
struct DeviceOfProfile {
  std::string name;  ///< As it is written after `--device`, for messages.
  device::DeviceIdentity identity;
  bool is_simulated = false;
  /// It says that it is a simulation, even if it is opened as a real device. Then a profile of
  /// a simulated device fits.
  bool says_simulated = false;
};

[[nodiscard]] DeviceOfProfile device_of_profile(const std::string& name,
                                                const device::HapticDevice& device);

/// Asks the device without opening it. Throws as `device::make_device` does.
[[nodiscard]] DeviceOfProfile device_of_profile(const std::string& name, double rate_hz);

/// What the folders contain for a device.
struct FoundProfile {
  /// The profile that was measured last. Of the same day, it is the one that was checked last,
  /// and then the one that was checked most often.
  std::optional<KnownProfile> known;
  /// Why it must not be used, in a sentence; "" if it may.
  std::string problem;
  /// Sentences about other profiles that fit, and about files that cannot be read.
  std::vector<std::string> remarks;
};
[[nodiscard]] FoundProfile find_profile(const DeviceOfProfile& device,
                                        const std::vector<std::filesystem::path>& folders,
                                        const std::string& on_day);

/// What a session on this device has to use.
struct ProfileChoice {
  std::optional<KnownProfile> known;
  std::string lack;  ///< Why a real device has no profile, in a sentence.
  std::vector<std::string> remarks;
};

/// `file` is the one that `--profile` names; it has to fit and be valid. Throws
/// `experiments::ProtocolError` if it is broken or was edited, and `core::Error` if it belongs
/// to another device or has expired. If `file` is "", a real device's own profile is looked
/// for, and a simulated device has none.
[[nodiscard]] ProfileChoice choose_profile(const DeviceOfProfile& device,
                                           const std::string& file,
                                           const std::vector<std::filesystem::path>& folders,
                                           const std::string& on_day);

/// The profile that a daily check of the device is about: this file, or the one that is found,
/// also for a simulated device. Its last check may have failed. Throws as `choose_profile`
/// does, and `core::Error` if there is none.
[[nodiscard]] KnownProfile profile_to_check(const DeviceOfProfile& device,
                                            const std::string& file,
                                            const std::vector<std::filesystem::path>& folders,
                                            const std::string& on_day);

/// True if anything in the study can be felt: a medium that is not free space, or a wall.
[[nodiscard]] bool asks_for_force(const experiments::Study& study);

/// Why a session of this study must not begin, in a sentence; "" if it may. A real device
/// without a valid profile may run what asks for no force.
[[nodiscard]] std::string refused_words(const DeviceOfProfile& device,
                                        const ProfileChoice& choice,
                                        const experiments::Study& study);

/// Why this session must not be resumed, in a sentence; "" if it may: its device tells another
/// model or serial, its measurements have changed since, or its profile has expired. `file` is
/// as in `choose_profile`; if no file is found any more, what the session stored counts.
[[nodiscard]] std::string refused_resume_words(
    const core::StudyStore& store, const core::SessionRow& session,
    const experiments::Study& study, const DeviceOfProfile& device, const std::string& file,
    const std::vector<std::filesystem::path>& folders, const std::string& on_day);

}  // namespace jnd::app
