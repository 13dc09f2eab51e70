#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "analysis/export/bids_text.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/option_checks.h"
#include "core/clock.h"
#include "core/storage/study_store.h"

namespace jnd::app {
namespace {

struct AdverseEventOptions {
  std::string folder;
  std::optional<std::int64_t> session;
  std::string text;
  bool json = false;
};

int print_adverse_events(const AdverseEventOptions& options) {
  const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
  auto list = nlohmann::ordered_json::array();
  for (const core::AdverseEventRow& row : store.adverse_events()) {
    if (options.session && row.session != *options.session) continue;
    list.push_back({{"session", row.session},
                    {"participant", row.participant},
                    {"time_ns", row.time_ns},
                    {"text", row.text}});
    if (options.json) continue;
    fmt::print("{}, {}, session {}: {}\n", analysis::iso_date(row.time_ns), row.participant,
               row.session, row.text);
  }
  if (options.json) {
    fmt::print("{}\n", json_text(nlohmann::ordered_json{{"adverse_events", list}}));
  } else if (list.empty()) {
    fmt::print("{}: no adverse event was reported\n", options.folder);
  }
  return kDone;
}

int run_adverse_event(const AdverseEventOptions& options) {
  if (options.text.empty()) return print_adverse_events(options);
  if (!options.session) {
    throw UsageError("--text: expected --session to say in which one it happened, found none");
  }
  core::StudyStore store(options.folder, core::StudyStore::Mode::kReadWrite);
  store.add_adverse_event(*options.session, core::SystemClock().now_ns(), options.text);
  fmt::print("{}, session {}: stored for good\n", store.session(*options.session).participant,
             *options.session);
  return kDone;
}

}  // namespace

HelpPlace place_of_adverse_event() { return {HelpGroup::kKeeping, 70}; }

void add_adverse_event(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "adverse-event",
      "Reports what must not happen to a participant and did, or lists what was reported");
  invocation.examples[command] = {
      {"jnd adverse-event my_study.study --session 1 --text \"a pinched finger\"",
       "is kept for good; without --text it lists them"}};
  const auto options = std::make_shared<AdverseEventOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--session", options->session, "In which session")
      ->check(whole_number(1, 1000000));
  command->add_option("--text", options->text,
                      "What happened; kept for good, also if the person withdraws");
  command->add_flag("--json", options->json, "Print the list as one JSON document");
  command->callback([&invocation, options] {
    invocation.run = [options] { return run_adverse_event(*options); };
  });
}

}  // namespace jnd::app
