#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/session/machine_checks.h"

namespace jnd::app {
namespace {

int run_doctor(bool as_json) {
  const std::vector<MachineCheck> checks = machine_checks();
  if (as_json) {
    nlohmann::json list = nlohmann::json::array();
    for (const MachineCheck& check : checks) {
      list.push_back({{"name", check.name},
                      {"ok", check.ok},
                      {"found", check.found},
                      {"remedy", check.remedy}});
    }
    std::puts(json_text(nlohmann::json{{"checks", std::move(list)}}).c_str());
    return kDone;
  }
  for (const MachineCheck& check : checks) {
    std::printf("%-5s %-20s %s\n", check.ok ? "ok" : "lacks", check.name.c_str(),
                check.found.c_str());
    if (!check.ok) std::printf("      %-20s %s\n", "", check.remedy.c_str());
  }
  return kDone;
}

}  // namespace

void add_doctor(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("doctor", "What this machine lacks, and what mends it");
  const auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "One JSON document on stdout");
  command->callback(
      [&invocation, as_json] { invocation.run = [as_json] { return run_doctor(*as_json); }; });
}

}  // namespace jnd::app
