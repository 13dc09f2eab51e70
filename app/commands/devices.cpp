#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "device/registry/device_registry.h"

namespace jnd::app {
namespace {

constexpr double kUsualRateHz = 1000.0;

int run_devices(bool json) {
  auto list = nlohmann::ordered_json::array();
  for (const device::DeviceEntry& entry : device::devices()) {
    const device::DeviceCapabilities can = entry.make("", kUsualRateHz)->capabilities();
    if (!json) {
      fmt::print(
          "{:<12} {}\n{:<12} {}, {} contact points, {:g} Hz, at most {:g} N at a point and "
          "{:g} N in all\n",
          entry.name, entry.description, "", can.simulated ? "simulated" : "real",
          can.num_contact_points, can.rate_hz, can.max_force_per_point_n,
          can.max_total_force_n);
    }
    list.push_back({{"name", entry.name},
                    {"description", entry.description},
                    {"simulated", can.simulated},
                    {"num_contact_points", can.num_contact_points},
                    {"rate_hz", can.rate_hz},
                    {"max_force_per_point_n", can.max_force_per_point_n},
                    {"max_total_force_n", can.max_total_force_n}});
  }
  if (json) fmt::print("{}\n", json_text(nlohmann::ordered_json{{"devices", list}}));
  return kDone;
}

}  // namespace

void add_devices(CLI::App& program, Invocation& invocation) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand("devices", "The devices that can be used here");
  command->add_flag("--json", *json, "Print one JSON document");
  command->callback(
      [json, &invocation] { invocation.run = [json] { return run_devices(*json); }; });
}

}  // namespace jnd::app
