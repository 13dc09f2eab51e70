#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "analysis/export/csv_export.h"
#include "app/commands/commands.h"
#include "app/session_setup.h"

namespace jnd::app {
namespace {

struct Options {
  std::string format;
  std::string folder;
  std::string out;
  analysis::CsvExportOptions csv;
};

int run(const Options& options) {
  const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
  require_unblinded(store);
  analysis::export_csv(store, options.out, options.csv);
  std::printf("%s: tables and codebook.csv written to %s\n", options.folder.c_str(),
              options.out.c_str());
  return kDone;
}

}  // namespace

void add_export(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("export", "A study as a data set for other programs");
  const auto options = std::make_shared<Options>();
  command->add_option("FORMAT", options->format, "csv")
      ->required()
      ->check(CLI::IsMember({"csv"}));
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", options->out, "Folder to write to: new or empty")->required();
  command->add_flag("--recordings", options->csv.recordings, "Also every sample");
  command->add_flag("--pilot", options->csv.pilot, "Also pilot sessions");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run(*options); }; });
}

}  // namespace jnd::app
