#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/command_line/command.h"
#include "experiments/device_profile/device_profile_table.h"
#include "experiments/protocol/reference_writer.h"
#include "experiments/protocol/schema_writer.h"

namespace jnd::app {

HelpPlace place_of_schema() { return {HelpGroup::kWriting, 20}; }

void add_schema(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "schema", "Print the JSON Schema (draft 7) of study files, or of device profiles");
  invocation.examples[command] = {
      {"jnd schema --markdown", "every key of a study file, to read"}};
  const auto json = std::make_shared<bool>(false);
  const auto markdown = std::make_shared<bool>(false);
  const auto profile = std::make_shared<bool>(false);
  CLI::Option* as_json = command->add_flag("--json", *json, "The schema is JSON either way");
  command
      ->add_flag("--markdown", *markdown,
                 "Print the same as a reference to read: every key, with examples")
      ->excludes(as_json);
  command->add_flag("--device-profile", *profile, "Of device profiles, NAME.device.json");
  command->callback([&invocation, json, markdown, profile] {
    invocation.run = [markdown, profile] {
      if (*profile) {
        fmt::print("{}", *markdown ? experiments::device_profile_reference()
                                   : experiments::device_profile_schema());
      } else {
        fmt::print("{}",
                   *markdown ? experiments::study_reference() : experiments::study_schema());
      }
      return static_cast<int>(kDone);
    };
  });
}

}  // namespace jnd::app
