#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "analysis/report/report.h"
#include "app/command_line/command.h"
#include "app/planning/power_files.h"

namespace jnd::app {
namespace {

struct PowerMergeOptions {
  std::vector<std::string> files;
  std::string out;
  bool json = false;
};

int run_power_merge(const PowerMergeOptions& options) {
  if (!options.out.empty()) analysis::require_free_folder(options.out);
  const MergedPower merged = merge_power_shards({options.files.begin(), options.files.end()});
  tell_power(merged.design, merged.runs, {.out = options.out, .json = options.json});
  return kDone;
}

}  // namespace

HelpPlace place_of_power_merge() { return {HelpGroup::kWriting, 60}; }

void add_power_merge(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "power-merge", "The result of `jnd power` from the shards of several machines");
  invocation.examples[command] = {{"jnd power-merge shard-*.json --out my_power",
                                   "joins what several machines have computed"}};
  const auto options = std::make_shared<PowerMergeOptions>();
  command->add_option("FILES", options->files, "Every shard-I-of-N.json")->required();
  command->add_option("--out", options->out, "New folder for power.json and the figure");
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_power_merge(*options); };
  });
}

}  // namespace jnd::app
