#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/usage_message.h"
#include "app/profile/profile_choice.h"
#include "app/session/found_ports.h"
#include "core/error.h"
#include "device/plugin/driver_description.h"
#include "device/plugin/plugin_device.h"
#include "device/plugin/plugin_options.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

constexpr double kUsualRateHz = 1000.0;

struct DevicesOptions {
  std::string device;  ///< "plugin:PATH", or "" for all devices.
  bool json = false;
};

/// What was measured of the device; null if no profile is found.
nlohmann::ordered_json profile_json(const FoundProfile& found) {
  if (!found.known) return nullptr;
  const experiments::DeviceProfile& profile = found.known->profile;
  return {{"file", found.known->place},
          {"measured_on", profile.measured_on},
          {"age_days", days_between(profile.measured_on, today())},
          {"valid_until", profile.valid_until},
          {"simulated", profile.simulated},
          {"problem", found.problem}};
}

std::string profile_words(const FoundProfile& found) {
  if (!found.known) return found.problem.empty() ? "none found" : found.problem;
  const std::string words =
      age_words(found.known->profile, today()) + ": " + found.known->place;
  return found.problem.empty() ? words : found.problem;
}

/// Prints what somebody else's driver says about its device.
int describe_plugin(const DevicesOptions& options) {
  if (device::kind_of(options.device) != "plugin") {
    throw UsageError("--device: expected plugin:PATH, found `" +
                     one_line(options.device.substr(0, 80)) +
                     "`; `jnd devices` alone tells of the others");
  }
  jnd_device_description told{};
  try {
    told = device::described_plugin(device::argument_of(options.device));
  } catch (const device::DeviceUnreachable&) {
    throw;
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  const device::DeviceCapabilities can = device::capabilities_of(told, told.rate_hz, true);
  nlohmann::ordered_json out;
  out["name"] = told.name;
  out["serial"] = told.serial;
  out["firmware"] = told.firmware;
  out["simulated"] = (told.flags & JND_DEVICE_IS_SIMULATED) != 0;
  out["tried_on_hardware"] = false;
  out["has"] = device::features_of(told);
  out["num_contact_points"] = can.num_contact_points();
  auto& shares = out["share_ratio"] = nlohmann::ordered_json::object();
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (!can.has_point(i)) continue;
    shares[std::string(core::kContactPointNames[i])] = can.share_ratio[i];
  }
  out["rate_hz"] = told.rate_hz;
  out["max_force_per_point_n"] = told.max_force_per_point_n;
  out["max_total_force_n"] = told.max_total_force_n;
  out["max_slew_n_per_s"] = told.max_slew_n_per_s;
  out["max_speed_m_per_s"] = told.max_speed_m_per_s;
  out["workspace_half_width_m"] = told.workspace_half_width_m;
  out["own_mass_kg"] = told.own_mass_kg;
  out["own_damping_n_s_per_m"] = told.own_damping_n_s_per_m;
  out["closed_loop_delay_s"] = told.closed_loop_delay_s;
  const FoundProfile profile = find_profile(
      {.name = options.device,
       .identity = {.model = told.name, .serial = told.serial, .firmware = told.firmware},
       .is_simulated = (told.flags & JND_DEVICE_IS_SIMULATED) != 0},
      profile_folders(), today());
  if (options.json) {
    out["profile"] = profile_json(profile);
    fmt::print("{}\n", json_text(out));
    return kDone;
  }
  out["profile"] = profile_words(profile);
  for (const auto& [key, value] : out.items()) {
    fmt::print("{:<24} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return kDone;
}

int run_devices(const DevicesOptions& options) {
  if (!options.device.empty()) return describe_plugin(options);
  const bool json = options.json;
  auto list = nlohmann::ordered_json::array();
  for (const device::DeviceEntry& entry : device::devices()) {
    const device::DeviceCapabilities can = entry.make("", kUsualRateHz)->capabilities();
    if (!json) {
      fmt::print(
          "{:<12} {}\n{:<12} {}, {} contact points, {:g} Hz, at most {:g} N at a point and "
          "{:g} N in all\n",
          entry.name, entry.description, "", can.simulated ? "simulated" : "real",
          can.num_contact_points(), can.rate_hz, can.max_force_per_point_n,
          can.max_total_force_n);
    }
    list.push_back({{"name", entry.name},
                    {"description", entry.description},
                    {"simulated", can.simulated},
                    {"num_contact_points", can.num_contact_points()},
                    {"rate_hz", can.rate_hz},
                    {"max_force_per_point_n", can.max_force_per_point_n},
                    {"max_total_force_n", can.max_total_force_n}});
  }
  auto plugins = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file : device::found_plugins()) {
    plugins.push_back(file.string());
    if (!json) fmt::print("plugin:{:<5} {}\n", file.stem().string(), file.string());
  }
  auto ports = nlohmann::ordered_json::array();
  for (const FoundPort& port : found_ports()) {
    ports.push_back({{"kind", kind_words(port.kind)},
                     {"path", port.path.string()},
                     {"name", port.name},
                     {"may_use", port.may_use},
                     {"group", group_of(port.kind)}});
    if (!json) {
      fmt::print("{:<12} {}{}{}\n", kind_words(port.kind), port.path.string(),
                 port.name.empty() ? "" : ": " + port.name,
                 port.may_use
                     ? ""
                     : fmt::format(" (not allowed; the group {} may)", group_of(port.kind)));
    }
  }
  if (json) {
    fmt::print("{}\n", json_text(nlohmann::ordered_json{{"devices", list},
                                                        {"plugins", plugins},
                                                        {"ports", ports},
                                                        {"tried_on_hardware", false}}));
  } else {
    fmt::print("All of this was tried with simulations alone, and not tried on hardware.\n");
  }
  return kDone;
}

}  // namespace

void add_devices(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<DevicesOptions>();
  CLI::App* command = program.add_subcommand(
      "devices", "The devices that can be used here, with the pedals and ports beside them");
  command->add_option("--device", options->device,
                      "plugin:PATH: what its driver says of it, without opening it");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback(
      [options, &invocation] { invocation.run = [options] { return run_devices(*options); }; });
}

}  // namespace jnd::app
