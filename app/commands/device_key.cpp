#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "core/error.h"
#include "device/network/device_key.h"

namespace jnd::app {
namespace {

int run_device_key(const std::string& name, bool json) {
  std::filesystem::path file;
  try {
    file = device::device_key_file(name);
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
  try {
    device::make_device_key(file);
  } catch (const core::Error& error) {
    throw EnvironmentError(error.what());
  }
  if (json) {
    fmt::print("{}\n",
               json_text(nlohmann::ordered_json{{"name", name}, {"file", file.string()}}));
    return kDone;
  }
  fmt::print(
      "{}\nCopy this file to the same place on the machine of the device, by a way that nobody "
      "else reads; whoever has it may command the device.\nThere: jnd device-server --device "
      "plugin:PATH:real --listen ADDRESS --key {}\nHere:  --device network:HOST:PORT,key={}\n",
      file.string(), name, name);
  return kDone;
}

}  // namespace

HelpPlace place_of_device_key() { return {HelpGroup::kApparatus, 110}; }

void add_device_key(CLI::App& program, Invocation& invocation) {
  struct Options {
    std::string name;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "device-key", "Draws a key that a program and a device on another machine share");
  invocation.examples[command] = {
      {"jnd device-key laboratory", "draws the key that both machines get a copy of"}};
  command->add_option("name", options->name, R"(Of the key: letters, digits, "-" and "_")")
      ->required();
  command->add_flag("--json", options->json, "Print one JSON document");
  command->callback([options, &invocation] {
    invocation.run = [options] { return run_device_key(options->name, options->json); };
  });
}

}  // namespace jnd::app
