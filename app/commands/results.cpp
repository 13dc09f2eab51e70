#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/json_text.h"
#include "app/option_checks.h"
#include "app/results_output.h"

namespace jnd::app {
namespace {

struct Options {
  std::string folder;
  bool json = false;
  analysis::ResultsOptions results;
};

int run(const Options& options) {
  const analysis::StudyResults results = results_of_folder(options.folder, options.results);
  if (options.json) {
    std::puts(json_text(to_json(results)).c_str());
  } else {
    std::fputs(to_table(results).c_str(), stdout);
  }
  return kDone;
}

}  // namespace

void add_results(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "results", "Every fit and comparison that a study's design calls for");
  const auto options = std::make_shared<Options>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--resamples", options->results.num_resamples,
                   "Resampled participants for group intervals")
      ->check(whole_number(100, 1000000))
      ->capture_default_str();
  command->add_option("--seed", options->results.seed, "Of the resampling")
      ->check(seed_number())
      ->capture_default_str();
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run(*options); }; });
}

}  // namespace jnd::app
