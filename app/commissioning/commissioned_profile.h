#pragma once

#include <string>

#include "app/commissioning/commissioning.h"
#include "experiments/device_profile/device_profile.h"

namespace jnd::app {

/// What was commissioned, as the profile that sessions rest on. Limits are those that the
/// device says, where they are no wider than what the program allows and the marks show: the
/// space reaches 50 cm beyond the marks that were touched. `today`: "2026-11-25"; it holds for
/// half a year from the last measurement on. Every step has been measured. Throws `core::Error`
/// where one is missing.
[[nodiscard]] experiments::DeviceProfile profile_of(const Commissioning& commissioning,
                                                    const device::DeviceIdentity& identity,
                                                    const std::string& program_version);

/// In kilograms, with what is open of the gain.
[[nodiscard]] analysis::Measured mass_kg(const analysis::DelayFit& delay,
                                         const analysis::Measured& gain);

}  // namespace jnd::app
