#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/commands/doctor_fix.h"
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

HelpPlace place_of_doctor() { return {HelpGroup::kApparatus, 60}; }

void add_doctor(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("doctor", "What this machine lacks, and what mends it");
  invocation.examples[command] = {
      {"jnd doctor", "tells what is lacking, and changes nothing"},
      {"sudo jnd doctor --fix",
       "makes the group jnd, joins whoever called sudo to it and gives it its rights"},
      {"jnd doctor --fix --dry-run", "prints the commands that it would run"}};
  const auto options = std::make_shared<DoctorFixOptions>();
  const auto fixes = std::make_shared<bool>(false);
  CLI::Option* fix = command->add_flag(
      "--fix", *fixes,
      "As root give the group jnd what it lacks (members, limits, devices, clocks of the "
      "processors) and say everything that is changed; without root print the commands");
  command->add_flag("--dry-run", options->dry_run, "With --fix: only say what would be done")
      ->needs(fix);
  command
      ->add_option(
          "--user", options->user,
          "With --fix: who runs sessions and joins the group; default: whoever called, "
          "or called sudo")
      ->needs(fix);
  command
      ->add_option("--root", options->root,
                   "With --fix: the folder of another system that is mended instead of this "
                   "one, such as an image that is being prepared")
      ->check(CLI::ExistingDirectory)
      ->needs(fix);
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback([&invocation, options, fixes] {
    invocation.run = [options, fixes] {
      return *fixes ? run_doctor_fix(*options) : run_doctor(options->json);
    };
  });
}

}  // namespace jnd::app
