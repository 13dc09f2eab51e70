#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "analysis/report/report.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/commands/compare_option.h"
#include "app/commands/effect_option.h"
#include "app/commands/participant_list.h"
#include "app/planning/power_files.h"
#include "app/planning/power_study.h"
#include "app/session/shipped_files.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace {

struct PowerOptions {
  std::string file;
  std::string participants;
  std::int64_t runs = 1000;
  std::string laboratory = "thesis";
  std::vector<std::string> effects;
  std::string compare;
  std::uint64_t seed = 1;
  int jobs = 2;
  std::string shard;
  std::string out;
  bool pse_at_reference = false;
  bool hierarchical = false;
  bool null_hypothesis = false;
  bool json = false;
};

/// Reads a shard such as "2/8".
std::optional<PowerShard> shard_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t slash = text.find('/');
  std::string index = text.substr(0, slash);
  std::string count = slash == std::string::npos ? "" : text.substr(slash + 1);
  const CLI::Validator whole = whole_number(1, 100000);
  if (whole(index).empty() && whole(count).empty() && std::stoi(index) <= std::stoi(count)) {
    return PowerShard{.index = std::stoi(index) - 1, .count = std::stoi(count)};
  }
  throw UsageError("--shard: expected I/N with I from 1 to N, such as 2/8, found `" + text +
                   "`");
}

int run_power(const PowerOptions& options) {
  std::optional<analysis::BlockNames> compared;
  if (!options.compare.empty()) compared = compared_names(options.compare);
  const PowerRequest request = {
      .sizes = participant_list(options.participants, "--participants"),
      .num_runs = options.runs,
      .seed = options.seed,
      .compare = compared,
      .free_pse = !options.pse_at_reference,
      .hierarchical = options.hierarchical,
      .null_hypothesis = options.null_hypothesis};
  const std::optional<PowerShard> shard = shard_of(options.shard);
  if (shard && options.out.empty()) {
    throw UsageError("--shard: expected --out with it, the folder that takes the shard's file");
  }
  if (!shard && !options.out.empty()) analysis::require_free_folder(options.out);
  const experiments::Study study =
      experiments::read_study(user_or_shipped(options.file, "protocols"));
  const experiments::Laboratory laboratory =
      laboratory_with_effects(options.laboratory, options.effects);
  const PowerStudy power(study, laboratory, request);
  stop_on_signals();
  std::vector<analysis::PlannedRun> runs;
  {
    ProgressBar bar("power");
    runs = power.run({.shard = shard.value_or(PowerShard{}),
                      .jobs = options.jobs,
                      .on_progress = [&bar](double done) { bar.show(done); },
                      .is_cancelled = [] { return stop_requested(); }});
  }
  if (!shard) {
    tell_power(power.design(), runs, {.out = options.out, .json = options.json});
    return kDone;
  }
  const std::filesystem::path file =
      write_power_shard(options.out, power.design(), *shard, runs);
  if (options.json) {
    const nlohmann::ordered_json document = {{"shard", {shard->index + 1, shard->count}},
                                             {"runs", runs.size()},
                                             {"file", file.string()}};
    std::puts(json_text(document).c_str());
  } else {
    std::printf("%zu runs in %s\n", runs.size(), file.c_str());
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_power() { return {HelpGroup::kWriting, 50}; }

void add_power(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "power", "Power, precision and duration of a study by number of participants, simulated");
  invocation.examples[command] = {{"jnd power my_study.json --participants 6,8..40 --runs 1000",
                                   "how many participants it takes"}};
  const auto options = std::make_shared<PowerOptions>();
  command->add_option("FILE", options->file, "Study file, or the name of a shipped study")
      ->required();
  command
      ->add_option("--participants", options->participants, "How many: 13, or 6,8..40, or 5..9")
      ->required();
  command->add_option("--runs", options->runs, "Simulated studies of each size")
      ->check(whole_number(1, 1000000))
      ->capture_default_str();
  command
      ->add_option("--laboratory", options->laboratory,
                   "Laboratory file, or a shipped one; misspecified does not share the formula "
                   "of the fits")
      ->capture_default_str();
  add_effect_option(*command, options->effects);
  command->add_option("--compare", options->compare,
                      "Two blocks with a reference, A,B, besides the contrasts that the study "
                      "plans; default: the first two of one quantity where it plans none");
  command->add_flag("--pse-at-reference", options->pse_at_reference,
                    "Hold the pse at the reference, as the thesis fits; default: free");
  command->add_flag("--hierarchical", options->hierarchical,
                    "Also the hierarchical fit: about a second a run and size");
  command->add_flag("--null", options->null_hypothesis,
                    "In a laboratory where both blocks have the same Weber fraction: how often "
                    "a difference is found that is none");
  command->add_option("--seed", options->seed, "Of everything that is drawn")
      ->check(seed_number())
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Runs at once; the result is the same for any")
      ->check(whole_number(1, 1024))
      ->capture_default_str();
  command->add_option("--shard", options->shard,
                      "I/N: only every Nth run from the Ith, for `jnd power-merge`");
  command->add_option("--out", options->out,
                      "Folder for power.json and the figure, or for the shard");
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_power(*options); }; });
}

}  // namespace jnd::app
