#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "app/command_line/command.h"
#include "app/operator/export_actions.h"

namespace jnd::app {
namespace {

struct UnblindOptions {
  std::string folder;
  std::string reason;
};

int run_unblind(const UnblindOptions& options) {
  if (options.reason.empty()) {
    throw UsageError("--reason: expected why, for those who read the data, found nothing");
  }
  std::printf("%s\n", unblind_study(options.folder, options.reason).sentence.c_str());
  return kDone;
}

}  // namespace

HelpPlace place_of_unblind() { return {HelpGroup::kKeeping, 50}; }

void add_unblind(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "unblind", "Lets the levels of a double-blind study be seen, and leaves a record");
  invocation.examples[command] = {
      {"jnd unblind my_study.study --reason \"data are complete\"",
       "the levels of a double-blind study can be seen from now on"}};
  const auto options = std::make_shared<UnblindOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--reason", options->reason, "Why; kept with the data")->required();
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_unblind(*options); }; });
}

}  // namespace jnd::app
