#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands/commands.h"
#include "experiments/study/schema_writer.h"

namespace jnd::app {

void add_schema(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("schema", "Print the JSON Schema (draft 7) of study files");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "The schema is JSON either way");
  command->callback([&invocation, json] {
    invocation.run = [] {
      fmt::print("{}", experiments::study_schema());
      return static_cast<int>(kDone);
    };
  });
}

}  // namespace jnd::app
