#pragma once

#include <filesystem>
#include <string>

#include "experiments/device_profile/device_profile.h"

namespace jnd::experiments {

/// Returns the profile as a file: keys in the order of the table, every number in the fewest
/// digits that identify it (17 at most), signed, and with a line end. Not real time.
[[nodiscard]] std::string device_profile_text(const DeviceProfile& profile);

/// Writes the profile into this folder as NAME.device.json and returns the file, which is on
/// disk by then. The folder is made if it is missing. If the name is taken, the file is called
/// NAME-DATE.device.json, where DATE is the last day of measurement or check, or gets a number
/// after the date. The schema is put beside it. Nothing is ever overwritten. Throws
/// `core::Error`. Not real time.
std::filesystem::path write_device_profile(const DeviceProfile& profile,
                                           const std::filesystem::path& folder);

/// Appends a check to those of the profile in this file and signs them again. Everything else
/// stays as it is, including comments. The file is replaced as a whole and is on disk when the
/// function returns. Whatever happens, the file exists, with the check or without it. If two
/// programs add a check at once, both are added. Throws `core::Error`, or `ProtocolError` if
/// the profile is invalid or would be with this check. Not real time.
void add_daily_check(const std::filesystem::path& file, const DailyCheck& check);

}  // namespace jnd::experiments
