#include <CLI/CLI.hpp>
#include <memory>

#include "app/command_line/command.h"
#include "app/commands/device_serving.h"

namespace jnd::app {

HelpPlace place_of_device_server() { return {HelpGroup::kApparatus, 100}; }

void add_device_server(CLI::App& program, Invocation& invocation) {
  auto options = std::make_shared<DeviceServing>();
  CLI::App* command = program.add_subcommand(
      "device-server",
      "Serves a device of this machine, such as plugin:PATH, to `--device network:HOST:PORT`");
  invocation.examples[command] = {{"jnd device-server --device plugin:./my_driver.so",
                                   "serves a driver of yours to a window on another machine"}};
  command
      ->add_option("--device", options->device,
                   "As after --device of other commands: plugin:PATH")
      ->required();
  add_serving_options(*command, *options);
  command->callback([options, &invocation] {
    invocation.run = [options] { return serve_device(*options); };
  });
}

}  // namespace jnd::app
