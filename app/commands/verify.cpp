#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/progress_bar.h"
#include "app/session/replay_check.h"
#include "core/storage/integrity.h"

namespace jnd::app {
namespace {

struct VerifyOptions {
  std::string folder;
  bool json = false;
};

nlohmann::json to_json(const std::vector<core::Finding>& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const core::Finding& finding : findings) {
    list.push_back({{"session", finding.session == 0 ? nlohmann::json(nullptr)
                                                     : nlohmann::json(finding.session)},
                    {"message", finding.message}});
  }
  return list;
}

void print(const char* title, const std::vector<core::Finding>& findings) {
  for (const core::Finding& finding : findings) {
    if (finding.session == 0) {
      std::printf("  %s: %s\n", title, finding.message.c_str());
    } else {
      std::printf("  %s: session %lld: %s\n", title, static_cast<long long>(finding.session),
                  finding.message.c_str());
    }
  }
}

/// A database that cannot even be opened is a finding like any other.
core::Integrity integrity_of(const std::string& folder) try {
  const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
  ProgressBar bar("verify");
  const core::Progress progress = [&bar](double done) { bar.show(done); };
  core::Integrity integrity = core::verify(store, core::part_of(progress, 0.0, 0.6));
  check_replay(store, integrity, core::part_of(progress, 0.6, 1.0));
  return integrity;
} catch (const core::Error& error) {
  return {.complete = false, .problems = {{0, error.what()}}};
}

int run_verify(const VerifyOptions& options) {
  const core::Integrity integrity = integrity_of(options.folder);
  if (options.json) {
    const nlohmann::json document = {
        {"complete", integrity.complete},        {"problems", to_json(integrity.problems)},
        {"remarks", to_json(integrity.remarks)}, {"num_sessions", integrity.num_sessions},
        {"num_events", integrity.num_events},    {"num_trials", integrity.num_trials},
        {"num_samples", integrity.num_samples}};
    std::puts(json_text(document).c_str());
  } else {
    std::printf("%s: %lld sessions, %lld events, %lld answered trials, %lld samples: %s\n",
                options.folder.c_str(), static_cast<long long>(integrity.num_sessions),
                static_cast<long long>(integrity.num_events),
                static_cast<long long>(integrity.num_trials),
                static_cast<long long>(integrity.num_samples),
                integrity.complete ? "complete" : "NOT complete");
    print("problem", integrity.problems);
    print("remark", integrity.remarks);
  }
  return integrity.complete ? kDone : kHasProblems;
}

}  // namespace

HelpPlace place_of_verify() { return {HelpGroup::kKeeping, 10}; }

void add_verify(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "verify", "Compares what a study should hold with what it does hold");
  invocation.examples[command] = {
      {"jnd verify my_study.study", "proves that every answer and sample is there"}};
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_verify(*options); }; });
}

}  // namespace jnd::app
