#pragma once

#include <optional>
#include <string>

#include "app/profile/known_profile.h"
#include "experiments/study/study.h"

namespace CLI {
class App;
}

namespace jnd::app {

/// `--profile FILE`: what was measured of the device.
void add_profile_option(CLI::App& command, std::string& file);

/// What was measured of this device, if anything: of `file`, or a real device's own where it is
/// found, with remarks on stderr. Throws as `choose_profile`, and `EnvironmentError` where the
/// study must not be run without one.
[[nodiscard]] std::optional<KnownProfile> profile_for(const std::string& device,
                                                      const std::string& file,
                                                      const experiments::Study& study);

}  // namespace jnd::app
