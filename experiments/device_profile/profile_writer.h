#pragma once

#include <filesystem>
#include <string>

#include "experiments/device_profile/device_profile.h"

namespace jnd::experiments {

/// The profile as a file has it: keys in the order of the table, every number in the fewest
/// digits that say it exactly (17 at most), signed, with a line end. Not real time.
[[nodiscard]] std::string device_profile_text(const DeviceProfile& profile);

/// Writes it into this folder, made if absent, as NAME.device.json; where that is there already
/// as NAME-DATE.device.json, DATE being the last day of measurement or check, or with a number
/// behind the date. The schema is put beside it. Nothing is ever overwritten. On disk when it
/// returns the file. Throws `core::Error`. Not real time.
std::filesystem::path write_device_profile(const DeviceProfile& profile,
                                           const std::filesystem::path& folder);

}  // namespace jnd::experiments
