#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "analysis/export/bids_export.h"
#include "analysis/export/csv_export.h"
#include "analysis/export/hdf5_export.h"
#include "app/commands/commands.h"
#include "app/json_text.h"
#include "app/results_output.h"
#include "app/session_setup.h"

namespace jnd::app {
namespace {

struct Options {
  std::string format;
  std::string folder;
  std::string out;
  analysis::ExportOptions data;
};

/// What `jnd results --json` says; "" if there is no session but pilots.
std::string results_text(const core::StudyStore& store) {
  const std::vector<core::SessionRow> sessions = store.sessions();
  const bool any = std::any_of(sessions.begin(), sessions.end(),
                               [](const core::SessionRow& row) { return !row.pilot; });
  return any ? json_text(to_json(results_of_data(analysis::load_study(store)))) : "";
}

bool lacks_recordings(const core::StudyStore& store, const analysis::ExportOptions& options) {
  const std::vector<core::SessionRow> sessions = analysis::exported_sessions(store, options);
  return std::none_of(sessions.begin(), sessions.end(), [&store](const auto& row) {
    return std::filesystem::exists(store.recording_file(row.session));
  });
}

/// What the data set consists of, for a person.
std::string export_as(const Options& options, const core::StudyStore& store) {
  const bool unrecorded = lacks_recordings(store, options.data);
  const std::string none = unrecorded ? "; the study has no recordings" : "";
  if (options.format == "bids") {
    analysis::export_bids(store, options.out, options.data, results_text(store));
    if (options.data.recordings && !unrecorded) return "a BIDS data set with motion";
    return "a BIDS data set without motion" + (unrecorded ? none : "; --recordings adds it");
  }
  if (options.format == "hdf5") {
    analysis::export_hdf5(store, options.out, options.data);
    return "study.h5" + none;
  }
  analysis::export_csv(store, options.out, options.data);
  return "tables and codebook.csv" + (options.data.recordings ? none : "");
}

int run(const Options& options) {
  const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
  require_unblinded(store);
  const std::string what = export_as(options, store);
  std::printf("%s: written to %s: %s\n", options.folder.c_str(), options.out.c_str(),
              what.c_str());
  return kDone;
}

}  // namespace

void add_export(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("export", "A study as a data set for other programs");
  const auto options = std::make_shared<Options>();
  command
      ->add_option("FORMAT", options->format,
                   "csv: tables; bids: BIDS 1.9.0; hdf5: recordings, tables beside them")
      ->required()
      ->check(CLI::IsMember({"csv", "bids", "hdf5"}));
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", options->out, "Folder to write to: new or empty")->required();
  command->add_flag("--recordings", options->data.recordings,
                    "Also every sample; hdf5 always has them");
  command->add_flag("--pilot", options->data.pilot, "Also pilot sessions");
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run(*options); }; });
}

}  // namespace jnd::app
