#include <CLI/CLI.hpp>
#include <memory>

#include "app/command_line/command.h"
#include "app/commands/device_serving.h"

namespace jnd::app {

HelpPlace place_of_device_simulator() { return {HelpGroup::kApparatus, 90}; }

void add_device_simulator(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<DeviceServing>();
  options->is_simulator = true;
  options->device = "lumped";
  CLI::App* command = program.add_subcommand(
      "device-simulator", "Serves a simulated device to `--device network:HOST:PORT`");
  invocation.examples[command] = {{"jnd device-simulator --port 4700",
                                   "serves the simulated exoskeleton to other programs"}};
  command->add_option("--device", options->device, "A simulated one, see `jnd devices`")
      ->capture_default_str();
  add_serving_options(*command, *options);
  command->callback([options, &invocation] {
    invocation.run = [options] { return serve_device(*options); };
  });
}

}  // namespace jnd::app
