#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/progress_bar.h"
#include "core/clock.h"
#include "core/storage/backup.h"

namespace jnd::app {
namespace {

struct BackupOptions {
  std::string folder;
  std::string target;
  std::string forget;
  bool json = false;
};

int print_copy(const core::BackupReport& report, const std::string& target, bool json) {
  std::vector<std::string> problems;
  for (const core::Finding& finding : report.integrity.problems) {
    problems.push_back((finding.session == 0
                            ? std::string()
                            : "session " + std::to_string(finding.session) + ": ") +
                       finding.message);
  }
  if (json) {
    const nlohmann::json document = {{"complete", report.integrity.complete},
                                     {"problems", problems},
                                     {"remarks", report.remarks},
                                     {"on_one_disk", report.on_one_disk},
                                     {"num_sessions", report.integrity.num_sessions},
                                     {"num_events", report.integrity.num_events},
                                     {"num_samples", report.integrity.num_samples},
                                     {"num_chunks", report.num_chunks},
                                     {"num_chunks_copied", report.num_chunks_copied}};
    std::puts(json_text(document).c_str());
  } else {
    std::printf(
        "%s: %lld sessions, %lld events, %lld of %lld recorded chunks new, read back: %s\n",
        target.c_str(), static_cast<long long>(report.integrity.num_sessions),
        static_cast<long long>(report.integrity.num_events),
        static_cast<long long>(report.num_chunks_copied),
        static_cast<long long>(report.num_chunks),
        report.integrity.complete ? "complete" : "NOT complete");
    for (const std::string& problem : problems) std::printf("  problem: %s\n", problem.c_str());
    for (const std::string& remark : report.remarks) {
      std::printf("  remark: %s\n", remark.c_str());
    }
    if (report.on_one_disk) {
      std::puts(
          "  remark: study and backup are on one disk; a disk that fails takes both, so keep "
          "another backup on another disk");
    }
  }
  return report.integrity.complete ? kDone : kHasProblems;
}

core::BackupReport backed_up(const BackupOptions& options) {
  ProgressBar bar("backup");
  return core::back_up(options.folder, options.target, core::SystemClock().now_ns(),
                       [&](double done) { bar.show(done); });
}

int run_backup(const BackupOptions& options) {
  if (options.target.empty() == options.forget.empty()) {
    throw UsageError("backup: expected --to with a folder, or --forget with one, found " +
                     std::string(options.target.empty() ? "neither" : "both"));
  }
  if (!options.forget.empty()) {
    core::forget_backup(options.folder, options.forget, core::SystemClock().now_ns());
    std::printf("%s: the backup in %s is forgotten; withdrawals will not look for it\n",
                options.folder.c_str(), options.forget.c_str());
    return kDone;
  }
  return print_copy(backed_up(options), options.target, options.json);
}

int run_restore(const BackupOptions& options) {
  ProgressBar bar("restore");
  const core::BackupReport report =
      core::restore(options.folder, options.target, core::SystemClock().now_ns(),
                    [&](double done) { bar.show(done); });
  return print_copy(report, options.target, options.json);
}

}  // namespace

HelpPlace place_of_backup() { return {HelpGroup::kKeeping, 20}; }

void add_backup(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "backup", "Copies a study, also while a session runs; again, copies what is new");
  invocation.examples[command] = {{"jnd backup my_study.study --to /media/disk/my_study",
                                   "copies what is new and reads it back"}};
  const auto options = std::make_shared<BackupOptions>();
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--to", options->target,
                      "Folder of the copy: new, empty, or an earlier backup of this study");
  command->add_option("--forget", options->forget,
                      "Folder of a copy that was deleted: withdrawals will not look for it");
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_backup(*options); }; });
}

HelpPlace place_of_restore() { return {HelpGroup::kKeeping, 30}; }

void add_restore(CLI::App& program, Invocation& invocation) {
  CLI::App* command = program.add_subcommand(
      "restore", "Makes a study of a backup, where the study itself is lost");
  invocation.examples[command] = {{"jnd restore /media/disk/my_study --to my_study.study",
                                   "a study again, made of its backup"}};
  const auto options = std::make_shared<BackupOptions>();
  command->add_option("DIR", options->folder, "Folder of the backup")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--to", options->target, "Folder of the study: new or empty")->required();
  command->add_flag("--json", options->json, "One JSON document on stdout");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_restore(*options); }; });
}

}  // namespace jnd::app
