#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/option_checks.h"
#include "app/session/reopened_session.h"
#include "core/error.h"

namespace jnd::app {
namespace {

struct ExcludeOptions {
  std::string folder;
  std::vector<std::int64_t> trials;
  std::string reason;
  std::string participant;
  std::optional<std::int64_t> session;
  bool include = false;
};

/// The one session that is meant, because trials are counted within a session.
core::SessionRow session_meant(const core::StudyStore& store, const ExcludeOptions& options) {
  std::vector<core::SessionRow> meant;
  for (const core::SessionRow& row : store.sessions()) {
    if (options.session && row.session != *options.session) continue;
    if (!options.participant.empty() && row.participant != options.participant) continue;
    meant.push_back(row);
  }
  if (meant.size() == 1) return meant.front();
  if (!meant.empty()) {
    throw UsageError(
        "--trial: expected --participant or --session to say whose trials, found " +
        std::to_string(meant.size()) + " sessions in " + options.folder);
  }
  throw core::Error(
      options.folder + ": expected " +
      (options.session ? "session " + std::to_string(*options.session) : "a session") +
      (options.participant.empty() ? "" : " of " + options.participant) + ", found none");
}

/// Checks all trials before the first one is changed.
void require_trials(const experiments::SessionState& state, const ExcludeOptions& options) {
  const auto num_trials = static_cast<std::int64_t>(state.trials.size());
  for (const std::int64_t trial : options.trials) {
    if (trial >= 1 && trial <= num_trials) continue;
    throw core::Error("--trial " + std::to_string(trial) + ": expected one of the session's " +
                      std::to_string(num_trials) + " trials, found none of that number");
  }
}

int run_exclude(const ExcludeOptions& options) {
  if (options.reason.empty()) {
    throw UsageError("--reason: expected why, for those who read the data, found nothing");
  }
  core::StudyStore store(options.folder, core::StudyStore::Mode::kReadWrite);
  const core::SessionRow row = session_meant(store, options);
  ReopenedSession reopened(store, row);
  experiments::Session& session = reopened.session();
  require_trials(session.state(), options);
  for (const std::int64_t trial : options.trials) {
    const bool already = session.state().trial(trial).excluded != options.include;
    if (!already && options.include) session.include(trial, options.reason);
    if (!already && !options.include) session.exclude(trial, options.reason);
    std::printf("%s, session %lld, trial %lld: %s%s\n", row.participant.c_str(),
                static_cast<long long>(row.session), static_cast<long long>(trial),
                options.include ? "included" : "excluded", already ? " already" : "");
  }
  return kDone;
}

}  // namespace

HelpPlace place_of_exclude() { return {HelpGroup::kKeeping, 40}; }

void add_exclude(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "exclude", "Leaves trials out of results, with a reason; nothing is deleted");
  invocation.examples[command] = {
      {"jnd exclude my_study.study --participant P01 --trial 3 4 --reason \"phone rang\"",
       "two trials are out of the results, not of the data"}};
  const auto options = std::make_shared<ExcludeOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--trial", options->trials,
                   "Numbers of trials in the session, as in trials.csv, with spaces between")
      ->required()
      ->check(whole_number(1, 1000000));
  command->add_option("--reason", options->reason, "Why; kept with the data")->required();
  command->add_option("--participant", options->participant, "Whose trials");
  command->add_option("--session", options->session, "Which session's trials")
      ->check(whole_number(1, 1000000));
  command->add_flag("--include", options->include, "Take an exclusion back");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_exclude(*options); }; });
}

}  // namespace jnd::app
