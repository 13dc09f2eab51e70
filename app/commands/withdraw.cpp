#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "analysis/export/bids_text.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "core/clock.h"
#include "core/storage/study_store.h"
#include "core/storage/withdrawal.h"

namespace jnd::app {
namespace {

struct WithdrawOptions {
  std::string folder;
  std::string participant;
  bool yes = false;
  bool acknowledge_exports = false;
  bool json = false;
};

/// On a terminal, asks for the pseudonym again, because a withdrawal cannot be undone.
bool confirmed(const WithdrawOptions& options) {
  if (options.yes || ::isatty(STDIN_FILENO) == 0) return true;
  std::fprintf(stderr,
               "This deletes every answer and every sample of %s, here and in the backups that "
               "%s knows of, for good.\nType the pseudonym again to go on: ",
               options.participant.c_str(), options.folder.c_str());
  std::string typed;
  std::getline(std::cin, typed);
  return typed == options.participant;
}

nlohmann::json withdrawal_json(const core::WithdrawalReport& report,
                               const std::string& participant) {
  std::vector<std::string> backups;
  for (const auto& backup : report.backups) backups.push_back(backup.string());
  nlohmann::json exports = nlohmann::json::array();
  for (const core::ExportNote& one : report.exports) {
    exports.push_back(
        {{"place", one.place.string()}, {"kind", one.kind}, {"time_ns", one.time_ns}});
  }
  return {{"participant", participant},
          {"sessions", report.sessions},
          {"backups", backups},
          {"remaining", report.remaining},
          {"exports", std::move(exports)}};
}

/// Counts adverse events, which are kept when the person's data are deleted.
std::size_t num_adverse_events(const WithdrawOptions& options) {
  const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
  const std::vector<core::AdverseEventRow> all = store.adverse_events();
  return static_cast<std::size_t>(
      std::ranges::count(all, options.participant, &core::AdverseEventRow::participant));
}

void print_withdrawal(const core::WithdrawalReport& report, const WithdrawOptions& options) {
  std::printf("%s: %s withdrew; %zu sessions deleted here and in %zu backups\n",
              options.folder.c_str(), options.participant.c_str(), report.sessions.size(),
              report.backups.size());
  for (const std::string& remaining : report.remaining) {
    std::printf("  not reached: %s\n", remaining.c_str());
  }
  if (const std::size_t kept = num_adverse_events(options); kept > 0) {
    std::printf("  kept: %zu adverse events, as `jnd adverse-event %s` lists them\n", kept,
                options.folder.c_str());
  }
  for (const core::ExportNote& one : report.exports) {
    std::printf("  not deleted: %s: %s of %s that holds %s\n", one.place.c_str(),
                one.kind == "report" ? "a report" : ("an export (" + one.kind + ")").c_str(),
                analysis::iso_date(one.time_ns).c_str(), options.participant.c_str());
  }
}

int run_withdraw(const WithdrawOptions& options) {
  if (!confirmed(options)) {
    throw UsageError("withdraw: expected the pseudonym " + options.participant +
                     " to be typed again, found something else; nothing was deleted");
  }
  const core::WithdrawalReport report =
      core::withdraw(options.folder, options.participant, core::SystemClock().now_ns());
  if (options.json) {
    std::puts(json_text(withdrawal_json(report, options.participant)).c_str());
  } else {
    print_withdrawal(report, options);
  }
  if (!report.remaining.empty()) {
    std::fprintf(
        stderr,
        "jnd: a backup could not be reached; attach it and run this again, or if it is "
        "gone, say so "
        "with `jnd backup DIR --forget FOLDER`\n");
  }
  const bool asks_for_exports = !report.exports.empty() && !options.acknowledge_exports;
  if (asks_for_exports) {
    std::fprintf(
        stderr,
        "jnd: %s: expected no export or report that holds %s, found %zu, the first in "
        "%s; delete them (or the person in them) wherever they went and run this again, "
        "or say with --acknowledge-exports that you know of them\n",
        options.folder.c_str(), options.participant.c_str(), report.exports.size(),
        report.exports.front().place.c_str());
  }
  return report.remaining.empty() && !asks_for_exports ? kDone : kHasProblems;
}

}  // namespace

HelpPlace place_of_withdraw() { return {HelpGroup::kKeeping, 60}; }

void add_withdraw(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "withdraw", "Deletes a participant for good, also from known backups, and names exports");
  invocation.examples[command] = {{"jnd withdraw my_study.study --participant P01",
                                   "deletes a person for good, in known backups too"}};
  const auto options = std::make_shared<WithdrawOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--participant", options->participant, "Pseudonym, for example P01")
      ->required();
  command->add_flag("--yes", options->yes,
                    "Do not ask again on a terminal (elsewhere nothing is asked)");
  command->add_flag("--acknowledge-exports", options->acknowledge_exports,
                    "Exports and reports that hold the person and are still there are known: "
                    "name them, and exit 0");
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_withdraw(*options); };
  });
}

}  // namespace jnd::app
