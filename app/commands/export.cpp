#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>

#include "analysis/data/study_data.h"
#include "analysis/export/bids_export.h"
#include "analysis/export/csv_export.h"
#include "analysis/export/hdf5_export.h"
#include "analysis/export/xdf_export.h"
#include "app/command_line/command.h"
#include "app/command_line/json_text.h"
#include "app/command_line/progress_bar.h"
#include "app/command_line/stop_signals.h"
#include "app/preregistration/deviations.h"
#include "app/preregistration/preregistration.h"
#include "app/results/noted_export.h"
#include "app/results/results_output.h"
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

/// What `jnd results --json` says; "" if there is no session but pilots.
std::string results_text(const core::StudyStore& store, const core::Progress& progress) {
  const std::vector<core::SessionRow> sessions = store.sessions();
  const bool any = std::any_of(sessions.begin(), sessions.end(),
                               [](const core::SessionRow& row) { return !row.pilot; });
  if (!any) return "";
  return json_text(
      results_json(results_of_data(analysis::load_study(store), {.on_progress = progress})));
}

/// `studies`: those that were read, by their hash; reading one for each session would take most
/// of the time.
std::vector<std::string> stage_names_of(const core::StudyStore& store,
                                        const core::SessionRow& session,
                                        std::map<std::string, experiments::Study>& studies) {
  auto known = studies.find(session.protocol_sha256);
  if (known == studies.end()) {
    known =
        studies.emplace(session.protocol_sha256, stored_study(store, session.session)).first;
  }
  std::vector<std::string> names;
  for (const experiments::Stage* stage : stages_of_session(known->second, session.cells)) {
    names.push_back(stage->name);
  }
  return names;
}

struct Written {
  std::string what;  ///< What the data set consists of, for a person.
  std::vector<std::string> problems;
};

/// What is to be said of samples.
std::string samples_text(const analysis::ExportOutcome& outcome, bool asked) {
  if (outcome.samples) return " with samples";
  return asked ? "; the study has no samples to write" : "";
}

Written export_as(const ExportOptions& options, const core::StudyStore& store) {
  const bool asked = options.data.recordings;
  if (options.format == "bids") {
    // The results in it take most of the time.
    constexpr double kComputed = 0.7;
    const core::Progress& progress = options.data.on_progress;
    const std::string results = results_text(store, core::part_of(progress, 0.0, kComputed));
    analysis::ExportOptions data = options.data;
    data.on_progress = core::part_of(progress, kComputed, 1.0);
    const analysis::ExportOutcome outcome =
        analysis::export_bids(store, options.out, data, results);
    if (outcome.samples) return {"a BIDS data set with motion", outcome.problems};
    return {std::string("a BIDS data set without motion") +
                (asked ? "; the study has no samples of its tasks" : "; --recordings adds it"),
            outcome.problems};
  }
  if (options.format == "hdf5") {
    const analysis::ExportOutcome outcome =
        analysis::export_hdf5(store, options.out, options.data);
    return {"study.h5" + samples_text(outcome, true), outcome.problems};
  }
  if (options.format == "xdf") {
    const analysis::ExportOutcome outcome =
        analysis::export_xdf(store, options.out, options.data);
    return {"an XDF file for each session" + samples_text(outcome, true), outcome.problems};
  }
  const analysis::ExportOutcome outcome =
      analysis::export_csv(store, options.out, options.data);
  return {"tables and codebook.csv" + samples_text(outcome, asked), outcome.problems};
}

/// Only where it takes a while and much of a disk.
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

/// A file of streams holds all of a session, tick by tick.
void require_whole_sessions(const ExportOptions& options) {
  if (options.format != "xdf") return;
  const analysis::ExportSelection& selection = options.data.selection;
  if (selection.blocks.empty() && selection.rate_hz == 0.0) return;
  throw UsageError(
      "--block, --rate-hz: expected neither with xdf, which holds whole sessions at the rate "
      "of "
      "the loop; leave them away, or take csv, bids or hdf5");
}

int run_export(ExportOptions options) {
  require_whole_sessions(options);
  stop_on_signals();
  const core::StudyStore store(options.folder, core::StudyStore::Mode::kReadOnly);
  require_results_open(store);
  options.data.program_version = JND_VERSION;
  std::map<std::string, experiments::Study> studies;
  options.data.stage_names = [&](const core::SessionRow& session) {
    return stage_names_of(store, session, studies);
  };
  options.data.keep_going = [&options] {
    if (!stop_requested()) return;
    throw core::Error(options.out + ": expected time to finish, found a signal to stop");
  };
  // BIDS has them in its results.
  if (options.format != "bids" && kept_preregistration(store)) {
    options.data.preregistration = preregistered_study(store, analysis::load_study(store));
  }
  const std::string forgotten =
      noted_export(store, options.out, options.format, options.data.pilot);
  tell_size(options, store);
  const Written written = [&] {
    ProgressBar bar("export " + options.format);
    options.data.on_progress = [&bar](double done) { bar.show(done); };
    return export_as(options, store);
  }();
  std::printf("%s: written to %s: %s\n", options.folder.c_str(), options.out.c_str(),
              written.what.c_str());
  if (!forgotten.empty()) std::fprintf(stderr, "jnd: %s\n", forgotten.c_str());
  for (const std::string& problem : written.problems) {
    std::fprintf(stderr, "jnd: %s\n", problem.c_str());
  }
  return written.problems.empty() ? kDone : kHasProblems;
}

}  // namespace

void add_export(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("export", "A study as a data set for other programs");
  const auto options = std::make_shared<ExportOptions>();
  command
      ->add_option("FORMAT", options->format,
                   "csv: tables; bids: BIDS 1.9.0; hdf5: recordings, tables beside them; xdf: "
                   "markers, samples and recorded streams of each session")
      ->required()
      ->check(CLI::IsMember({"csv", "bids", "hdf5", "xdf"}));
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
