#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "app/commands/commands.h"
#include "app/reopened_session.h"
#include "app/session_setup.h"
#include "core/error.h"

namespace jnd::app {
namespace {

struct Options {
  std::string folder;
  std::string reason;
};

bool is_unblinded(const core::StudyStore& store, std::int64_t session) {
  const std::vector<core::EventRow> events = store.events(session);
  return std::any_of(events.begin(), events.end(),
                     [](const core::EventRow& event) { return event.kind == "unblinded"; });
}

int run(const Options& options) {
  if (options.reason.empty()) {
    throw UsageError("--reason: expected why, for those who read the data, found nothing");
  }
  core::StudyStore store(options.folder, core::StudyStore::Mode::kReadWrite);
  const std::vector<core::SessionRow> sessions = store.sessions();
  if (sessions.empty()) {
    throw core::Error(options.folder + ": expected a session to unblind, found none");
  }
  const bool blind = std::any_of(sessions.begin(), sessions.end(), [&](const auto& row) {
    return stored_study(store, row.session).blinding == experiments::Blinding::kDouble;
  });
  if (!blind) {
    throw core::Error(options.folder +
                      ": expected a double-blind study, found one whose levels may be seen");
  }
  store.add_unblinding(core::SystemClock().now_ns(), options.reason);
  // Every session keeps the moment: answers after it were no longer given blind.
  for (const core::SessionRow& row : sessions) {
    if (is_unblinded(store, row.session)) continue;  // By a run that was interrupted.
    ReopenedSession(store, row).session().unblind(options.reason);
  }
  std::printf("%s: unblinded, and so written in the log of its %zu sessions\n",
              options.folder.c_str(), sessions.size());
  return kDone;
}

}  // namespace

void add_unblind(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "unblind", "Lets the levels of a double-blind study be seen, and leaves a record");
  const auto options = std::make_shared<Options>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--reason", options->reason, "Why; kept with the data")->required();
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run(*options); }; });
}

}  // namespace jnd::app
