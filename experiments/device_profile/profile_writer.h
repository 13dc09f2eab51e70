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

/// Adds a check behind the others of the profile in this file, and signs them anew; everything
/// else stays as it stands there, comments too. The file is replaced as a whole and is on disk
/// when this returns; whatever happens, it is there with the check or without it. Two programs
/// that add at once both do. Throws `core::Error`, or `ProtocolError` where the profile is not
/// sound or would not be with this check. Not real time.
void add_daily_check(const std::filesystem::path& file, const DailyCheck& check);

}  // namespace jnd::experiments
