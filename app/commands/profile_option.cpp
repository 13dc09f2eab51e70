#include "app/commands/profile_option.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <utility>

#include "app/command_line/command.h"
#include "app/profile/profile_choice.h"

namespace jnd::app {

void add_profile_option(CLI::App& command, std::string& file) {
  command.add_option("--profile", file,
                     "What was measured of the device, NAME.device.json; default: a real "
                     "device's own, where it is found");
}

std::optional<KnownProfile> profile_for(const std::string& device, const std::string& file,
                                        const experiments::Study& study) {
  const DeviceOfProfile asked = device_of_profile(device, study.device.rate_hz);
  ProfileChoice choice = choose_profile(asked, file, profile_folders(), today());
  for (const std::string& remark : choice.remarks) {
    std::fprintf(stderr, "jnd: %s\n", remark.c_str());
  }
  const std::string refused = refused_words(asked, choice, study);
  if (!refused.empty()) throw EnvironmentError(refused);
  return std::move(choice.known);
}

}  // namespace jnd::app
