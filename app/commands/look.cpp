#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/results/sequential_look.h"
#include "core/storage/study_store.h"

namespace jnd::app {
namespace {

struct LookOptions {
  std::string folder;
  bool unseal = false;
  std::string reason;
  bool json = false;
};

std::string decision_words(const StudyProgress& progress) {
  const std::string kind = progress.simulated ? " SIMULATED" : "";
  if (progress.ended) {
    return fmt::format(
        "Stop: {} of at most {}{} participants have a complete session, and the rule of the "
        "study has ended it.",
        progress.num_complete, progress.max_participants, kind);
  }
  return fmt::format(
      "Go on: {} of at most {}{} participants have a complete session, the next look is at {}.",
      progress.num_complete, progress.max_participants, kind, progress.next_look);
}

int run_look(const LookOptions& options) {
  if (options.unseal && options.reason.empty()) {
    throw UsageError(
        "--unseal: expected --reason with it, why the results are opened before the end, for "
        "those who read them, found none");
  }
  if (!options.unseal && !options.reason.empty()) {
    throw UsageError("--reason: expected --unseal with it, found none");
  }
  core::StudyStore store(options.folder, core::StudyStore::Mode::kReadWrite);
  const StudyProgress progress = take_due_looks(store);
  if (options.unseal) unseal_study(store, progress, options.reason);
  if (options.json) {
    fmt::print("{}\n", json_text(nlohmann::ordered_json{
                           {"decision", progress.ended ? "stop" : "go_on"},
                           {"num_complete", progress.num_complete},
                           {"max_participants", progress.max_participants},
                           {"next_look", progress.next_look == 0
                                             ? nlohmann::ordered_json()
                                             : nlohmann::ordered_json(progress.next_look)},
                           {"simulated", progress.simulated},
                           {"unsealed", !store.unsealings().empty()}}));
    return kDone;
  }
  fmt::print("{}\n", decision_words(progress));
  if (options.unseal) {
    fmt::print(
        "{}: unsealed with {} complete sessions, and kept so; results can be read, and say "
        "that "
        "this was not planned.\n",
        options.folder, progress.num_complete);
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_look() { return {HelpGroup::kRunning, 40}; }

void add_look(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "look", "Whether a study that plans looks goes on or stops, and nothing else");
  invocation.examples[command] = {
      {"jnd look my_study.study", "says go on or stop, and nothing else"}};
  const auto options = std::make_shared<LookOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_flag("--unseal", options->unseal,
                    "Open the results before the rule has ended the study; it is kept, and "
                    "told with them");
  command->add_option("--reason", options->reason, "Why they are opened; kept with the data");
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_look(*options); }; });
}

}  // namespace jnd::app
