#pragma once

#include <string>

#include "app/commissioning/commissioning.h"
#include "experiments/device_profile/device_profile.h"

namespace jnd::app {

/// Makes the profile on which sessions rest from what was commissioned. Its limits are those
/// that the device declares, as long as they are no wider than what the program allows and the
/// marks show: the workspace reaches 50 cm beyond the marks that were touched. The profile is
/// valid for half a year from the last measurement on. Throws `core::Error` if a step was not
/// measured.
[[nodiscard]] experiments::DeviceProfile profile_of(const Commissioning& commissioning,
                                                    const device::DeviceIdentity& identity,
                                                    const std::string& program_version);

/// The mass in kilograms; its interval includes the uncertainty of the gain.
[[nodiscard]] analysis::Measured mass_kg(const analysis::DelayFit& delay,
                                         const analysis::Measured& gain);

}  // namespace jnd::app
