#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/results/study_export.h"
#include "app/session/stored_session.h"
#include "core/error.h"

namespace jnd::app {
namespace {

struct ExportOptions {
  std::string format;
  std::string folder;
  std::string out;
  analysis::ExportOptions data;
};

/// Tells the size if the export takes a while and much of a disk.
void tell_size(const ExportOptions& options, const core::StudyStore& store) {
  constexpr double kWorthTelling = 50e6, kTooLargeForMost = 500e6;
  const bool is_text = options.format == "csv" || options.format == "bids";
  if (is_text && !options.data.recordings) return;
  const analysis::ExpectedSize size = analysis::expected_size(store, options.data, is_text);
  if (size.bytes < kWorthTelling) return;
  std::printf("%s: %lld rows of samples of %lld sessions, about %.2g GB%s\n",
              options.folder.c_str(), static_cast<long long>(size.num_rows),
              static_cast<long long>(size.num_sessions), 1e-9 * size.bytes,
              is_text && size.bytes > kTooLargeForMost
                  ? "; --rate-hz and --channel take fewer, and hdf5 takes a tenth of that"
                  : "");
  std::fflush(stdout);
}

/// A file of streams holds the whole session, tick by tick.
void require_whole_sessions(const ExportOptions& options) {
  if (options.format != "xdf") return;
  const analysis::ExportSelection& selection = options.data.selection;
  if (selection.blocks.empty() && selection.rate_hz == 0.0) return;
  throw UsageError(
      "--block, --rate-hz: expected neither with xdf, which holds whole sessions at the rate "
      "of the loop; leave them away, or take csv, bids or hdf5");
}

int run_export(ExportOptions options) {
  require_whole_sessions(options);
  stop_on_signals();
  const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
  require_results_open(store);
  options.data.keep_going = [&options] {
    if (!stop_requested()) return;
    throw core::Error(options.out + ": expected time to finish, found a signal to stop");
  };
  tell_size(options, store);
  const StudyExport written = [&] {
    ProgressBar bar("export " + options.format);
    options.data.on_progress = [&bar](double done) { bar.show(done); };
    return write_study_export(
        store, {.format = options.format, .out = options.out, .data = options.data});
  }();
  std::printf("%s: written to %s: %s\n", options.folder.c_str(), options.out.c_str(),
              written.what.c_str());
  if (!written.forgotten.empty()) std::fprintf(stderr, "jnd: %s\n", written.forgotten.c_str());
  for (const std::string& problem : written.problems) {
    std::fprintf(stderr, "jnd: %s\n", problem.c_str());
  }
  return written.problems.empty() ? kDone : kHasProblems;
}

}  // namespace

HelpPlace place_of_export() { return {HelpGroup::kResults, 30}; }

void add_export(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("export", "A study as a data set for other programs");
  invocation.examples[command] = {
      {"jnd export csv my_study.study --out my_tables", "tidy tables with a codebook"},
      {"jnd export hdf5 my_study.study --out my_samples", "every sample of the loop"}};
  const auto options = std::make_shared<ExportOptions>();
  command
      ->add_option("FORMAT", options->format,
                   "csv: tables; bids: BIDS 1.9.0; hdf5: recordings, tables beside them; xdf: "
                   "markers, samples and recorded streams of each session")
      ->required()
      ->check(CLI::IsMember(
          std::vector<std::string>(kExportFormats.begin(), kExportFormats.end())));
  command->add_option("DIR", options->folder, "Study folder, NAME.study")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", options->out, "Folder to write to: new or empty")->required();
  command->add_flag("--recordings", options->data.recordings,
                    "Also every sample; hdf5 and xdf always have them");
  command->add_flag("--pilot", options->data.pilot, "Also pilot sessions");
  analysis::ExportSelection& selection = options->data.selection;
  command
      ->add_option("--participant", selection.participants,
                   "Of this one alone; may be given several times")
      ->type_name("PSEUDONYM");
  command
      ->add_option("--block", selection.blocks,
                   "Trials and samples of this block alone; may be given several times")
      ->type_name("NAME");
  command
      ->add_option("--channel", selection.channels,
                   "Of samples this one alone, as position_m or force_n, beside ticks and "
                   "flags (xdf: alone); may be given several times")
      ->type_name("NAME");
  command
      ->add_option("--rate-hz", selection.rate_hz,
                   "Of samples, a whole fraction of the loop's: each row is the mean of its "
                   "ticks")
      ->check(CLI::PositiveNumber);
  command->callback(
      [&invocation, options] { invocation.run = [options] { return run_export(*options); }; });
}

}  // namespace jnd::app
