#pragma once

#include <optional>
#include <string>

#include "app/profile/known_profile.h"
#include "experiments/study/study.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// Adds `--profile FILE`: what was measured of the device.
void add_profile_option(CLI::App& command, std::string& file);

/// What was measured of this device, if anything: in `file`, or in a real device's own profile
/// if it is found. Remarks go to stderr. Throws as `choose_profile` does, and
/// `EnvironmentError` if the study must not be run without a profile.
[[nodiscard]] std::optional<KnownProfile> profile_for(const std::string& device,
                                                      const std::string& file,
                                                      const experiments::Study& study);

}  // namespace jnd::app
