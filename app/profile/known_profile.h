#pragma once

#include <filesystem>
#include <string>

#include "core/storage/study_store.h"
#include "device/haptic_device.h"
#include "device/profiled_device.h"
#include "experiments/device_profile/device_profile.h"

namespace jnd::app {

/// A device profile with the text from which it was read.
struct KnownProfile {
  experiments::DeviceProfile profile;
  std::string text;  ///< The text, which a session stores.
  /// For messages: its file, or the study folder that stores it.
  std::string place;
};

/// Throws `experiments::ProtocolError` with every problem of the file; an edited measurement is
/// one. Not real time.
[[nodiscard]] KnownProfile read_known_profile(const std::filesystem::path& file);

/// The profile with which a session began. Throws `core::Error` if the folder lacks it, or if
/// it is damaged.
[[nodiscard]] KnownProfile stored_profile(const core::StudyStore& store,
                                          const std::string& sha256);

/// Today's date in the machine's time zone, such as 2026-11-25.
[[nodiscard]] std::string today();

/// The number of days from one date to another.
[[nodiscard]] int days_between(const std::string& from, const std::string& until);

/// The model, and the serial if it is known, such as "`wam` 17".
[[nodiscard]] std::string device_words(const std::string& model, const std::string& serial);

/// Such as "measured on 2026-11-20, 5 days ago, valid until 2027-11-20", with "SIMULATED" for a
/// simulated device.
[[nodiscard]] std::string age_words(const experiments::DeviceProfile& profile,
                                    const std::string& on_day);

/// Why the profile does not belong to this device, in a sentence with the profile's place; ""
/// if it does. Some devices tell their serial only when they are open, so a missing serial is
/// no difference until `is_open`. The profile of a simulated device belongs only to one that
/// says that it is simulated.
[[nodiscard]] std::string foreign_words(const KnownProfile& known,
                                        const device::DeviceIdentity& device,
                                        bool says_simulated, bool is_open);

/// Why the profile does not hold on this day, in such a sentence: it has expired. "" if it
/// holds.
[[nodiscard]] std::string ended_words(const KnownProfile& known, const std::string& on_day);

/// Why the profile cannot be used on this day, in such a sentence: it has expired, or its last
/// check failed. "" if it can.
[[nodiscard]] std::string outdated_words(const KnownProfile& known, const std::string& on_day);

/// The parameters that the profile sets for the device.
[[nodiscard]] device::ProfiledDevice::Parameters device_parameters(
    const experiments::DeviceProfile& profile);

}  // namespace jnd::app
