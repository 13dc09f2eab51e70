#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/usage_message.h"
#include "app/profile/profile_choice.h"
#include "app/session/device_checks.h"
#include "app/session/found_ports.h"
#include "core/device_channels.h"
#include "core/error.h"
#include "device/network/network_device.h"
#include "device/plugin/driver_description.h"
#include "device/plugin/plugin_device.h"
#include "device/plugin/plugin_options.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

constexpr double kUsualRateHz = 1000.0;
constexpr double kAnySpeed_m_per_s = 0.5;

struct DevicesOptions {
  std::string device;  ///< "plugin:PATH" or "network:HOST:PORT"; "": all.
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

/// What one device says of itself, wherever it is.
struct SelfDescription {
  device::DeviceIdentity identity;
  device::DeviceCapabilities can;
  bool says_simulated = false;
  std::vector<std::string> has;
};

SelfDescription described_driver(const std::string& argument) {
  const jnd_device_description told = device::described_plugin(argument);
  return {.identity = device::identity_of(told),
          .can = device::capabilities_of(told, told.rate_hz, true),
          .says_simulated = (told.flags & JND_DEVICE_IS_SIMULATED) != 0,
          .has = device::features_of(told)};
}

/// In the words of `device::features_of`; every state of the datagrams has the first three.
SelfDescription described_server(const std::string& argument) {
  const std::unique_ptr<device::NetworkDevice> served = device::asked_network_device(argument);
  SelfDescription told{.identity = served->identity(),
                       .can = served->capabilities(),
                       .says_simulated = served->says_simulated(),
                       .has = {"own_clock", "acted_force", "device_time"}};
  if (told.can.moves_by_itself) told.has.emplace_back("own_movement");
  if (told.can.has_enable_switch) told.has.emplace_back("enable_switch");
  for (std::string& name : core::channel_names(told.can.channels)) {
    told.has.push_back(std::move(name));
  }
  return told;
}

/// Numbers that it does not say and things that it does not have, by the keys of the document.
std::vector<std::string> lacks_of(const SelfDescription& told) {
  std::vector<std::string> lacks;
  const auto add_unless = [&lacks](bool is_there, std::string_view name) {
    if (!is_there) lacks.emplace_back(name);
  };
  const device::DeviceCapabilities& can = told.can;
  add_unless(!told.identity.serial.empty(), "serial");
  add_unless(!told.identity.firmware.empty(), "firmware");
  add_unless(std::isfinite(can.max_slew_n_per_s), "max_slew_n_per_s");
  add_unless(std::isfinite(can.max_speed_m_per_s), "max_speed_m_per_s");
  add_unless(std::isfinite(can.workspace.half_width_x_m), "workspace_half_width_m");
  add_unless(can.own_mass_kg > 0.0, "own_mass_kg");
  add_unless(can.own_damping_n_s_per_m > 0.0, "own_damping_n_s_per_m");
  add_unless(can.closed_loop_delay_s > 0.0, "closed_loop_delay_s");
  for (const std::string_view feature :
       {"acted_force", "device_time", "enable_switch", "measured_force", "orientation",
        "torque", "gripper", "buttons"}) {
    add_unless(std::ranges::find(told.has, feature) != told.has.end(), feature);
  }
  return lacks;
}

/// null: it does not say.
nlohmann::ordered_json told_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

/// One line of the table.
std::string shown(const nlohmann::ordered_json& value) {
  if (value.is_null()) return "it does not say";
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array() || value.empty() || !value.front().is_string()) return value.dump();
  return fmt::format("{}", fmt::join(value.get<std::vector<std::string>>(), ", "));
}

/// What a device of somebody else's says of itself, without opening it.
int describe_device(const DevicesOptions& options) {
  const std::string kind(device::kind_of(options.device));
  const std::string argument(device::argument_of(options.device));
  if ((kind != "plugin" && kind != "network") || argument.empty()) {
    throw UsageError("--device: expected plugin:PATH or network:HOST:PORT, found `" +
                     one_line(options.device.substr(0, 80)) +
                     "`; `jnd devices` alone tells of the others");
  }
  SelfDescription told;
  try {
    told = kind == "plugin" ? described_driver(argument) : described_server(argument);
  } catch (const device::DeviceUnreachable&) {
    throw;
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  const device::DeviceCapabilities& can = told.can;
  nlohmann::ordered_json out;
  out["name"] = told.identity.model;
  out["serial"] = told.identity.serial;
  out["firmware"] = told.identity.firmware;
  out["simulated"] = told.says_simulated;
  out["tried_on_hardware"] = false;
  out["has"] = told.has;
  out["lacks"] = lacks_of(told);
  out["num_contact_points"] = can.num_contact_points();
  auto& shares = out["share_ratio"] = nlohmann::ordered_json::object();
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (!can.has_point(i)) continue;
    shares[std::string(core::kContactPointNames[i])] = can.share_ratio[i];
  }
  out["rate_hz"] = can.rate_hz;
  out["max_force_per_point_n"] = can.max_force_per_point_n;
  out["max_total_force_n"] = can.max_total_force_n;
  const experiments::RangeLimits limits = range_limits_of(can, kAnySpeed_m_per_s);
  out["rendered_max_force_per_point_n"] = limits.max_force_per_point_n;
  out["rendered_max_total_force_n"] = limits.max_total_force_n;
  out["max_slew_n_per_s"] = told_or_null(can.max_slew_n_per_s);
  out["max_speed_m_per_s"] = told_or_null(can.max_speed_m_per_s);
  out["workspace_half_width_m"] = {told_or_null(can.workspace.half_width_x_m),
                                   told_or_null(can.workspace.half_width_y_m),
                                   told_or_null(can.workspace.half_width_z_m)};
  out["own_mass_kg"] = can.own_mass_kg;
  out["own_damping_n_s_per_m"] = can.own_damping_n_s_per_m;
  out["closed_loop_delay_s"] = can.closed_loop_delay_s;
  const FoundProfile profile = find_profile({.name = options.device,
                                             .identity = told.identity,
                                             .says_simulated = told.says_simulated},
                                            profile_folders(), today());
  if (options.json) {
    out["profile"] = profile_json(profile);
    fmt::print("{}\n", json_text(out));
    return kDone;
  }
  out["profile"] = profile_words(profile);
  for (const auto& [key, value] : out.items()) fmt::print("{:<30} {}\n", key, shown(value));
  const std::string own_limit = own_limit_words(options.device, can);
  if (!own_limit.empty()) fmt::print("Note: {}.\n", own_limit);
  return kDone;
}

int run_devices(const DevicesOptions& options) {
  if (!options.device.empty()) return describe_device(options);
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

HelpPlace place_of_devices() { return {HelpGroup::kApparatus, 30}; }

void add_devices(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<DevicesOptions>();
  CLI::App* command = program.add_subcommand(
      "devices", "The devices that can be used here, with the pedals and ports beside them");
  invocation.examples[command] = {{"jnd devices", "what can be given to --device"}};
  command->add_option("--device", options->device,
                      "plugin:PATH or network:HOST:PORT: what this one says of itself, "
                      "without opening it");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback(
      [options, &invocation] { invocation.run = [options] { return run_devices(*options); }; });
}

}  // namespace jnd::app
