#pragma once

#include <filesystem>
#include <string>

#include "core/storage/study_store.h"
#include "device/haptic_device.h"
#include "device/profiled_device.h"
#include "experiments/device_profile/device_profile.h"

namespace jnd::app {

/// A device profile with the text that it was read from.
struct KnownProfile {
  experiments::DeviceProfile profile;
  std::string text;   ///< That a session keeps.
  std::string place;  ///< For messages: its file, or the study folder that keeps it.
};

/// Throws `experiments::ProtocolError` with every problem of the file, an edited measurement
/// among them. Not real time.
[[nodiscard]] KnownProfile read_known_profile(const std::filesystem::path& file);

/// What a session was begun with; throws `core::Error` where the folder lacks it or it is
/// damaged.
[[nodiscard]] KnownProfile stored_profile(const core::StudyStore& store,
                                          const std::string& sha256);

/// Today's day where this machine is, as 2026-11-25.
[[nodiscard]] std::string today();

/// Days from one date to another.
[[nodiscard]] int days_between(const std::string& from, const std::string& until);

/// "`wam` 17": model and serial, if it says one.
[[nodiscard]] std::string device_words(const std::string& model, const std::string& serial);

/// "measured on 2026-11-20, 5 days ago, valid until 2027-11-20", with "SIMULATED" where it is.
[[nodiscard]] std::string age_words(const experiments::DeviceProfile& profile,
                                    const std::string& on_day);

/// Why the profile is not of this device, a sentence with its place; "" if it is. A serial that
/// the device does not tell before it is open is no difference until `is_open`.
[[nodiscard]] std::string foreign_words(const KnownProfile& known,
                                        const device::DeviceIdentity& device, bool is_simulated,
                                        bool is_open);

/// Why the profile has no meaning on this day, likewise: it ended.
[[nodiscard]] std::string ended_words(const KnownProfile& known, const std::string& on_day);

/// Why the profile cannot be used on this day, likewise: it ended, or its last check failed.
[[nodiscard]] std::string outdated_words(const KnownProfile& known, const std::string& on_day);

/// What the device is asked for by the profile.
[[nodiscard]] device::ProfiledDevice::Parameters device_parameters(
    const experiments::DeviceProfile& profile);

}  // namespace jnd::app
