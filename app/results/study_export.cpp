#include "app/results/study_export.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/data/study_data.h"
#include "analysis/export/bids_export.h"
#include "analysis/export/csv_export.h"
#include "analysis/export/hdf5_export.h"
#include "analysis/export/xdf_export.h"
#include "app/command_line/json_text.h"
#include "app/preregistration/deviations.h"
#include "app/preregistration/preregistration.h"
#include "app/results/noted_export.h"
#include "app/results/results_output.h"
#include "app/session/stored_session.h"

namespace jnd::app {
namespace {

/// The output of `jnd results --json`; "" if all sessions are pilots.
std::string results_text(const core::StudyStore& store, const core::Progress& progress) {
  const std::vector<core::SessionRow> sessions = store.sessions();
  const bool any = std::any_of(sessions.begin(), sessions.end(),
                               [](const core::SessionRow& row) { return !row.pilot; });
  if (!any) return "";
  return json_text(
      results_json(results_of_data(analysis::load_study(store), {.on_progress = progress})));
}

/// `studies` holds the studies read so far, by their hash, because reading one for each session
/// would take most of the time.
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

/// What is said about samples.
std::string samples_text(const analysis::ExportOutcome& outcome, bool asked) {
  if (outcome.samples) return " with samples";
  return asked ? "; the study has no samples to write" : "";
}

StudyExport export_as(const core::StudyStore& store, const StudyExportRequest& options) {
  const bool asked = options.data.recordings;
  if (options.format == "bids") {
    // Computing the results takes most of the time.
    constexpr double kComputed = 0.7;
    const core::Progress& progress = options.data.on_progress;
    const std::string results = results_text(store, core::part_of(progress, 0.0, kComputed));
    analysis::ExportOptions data = options.data;
    data.on_progress = core::part_of(progress, kComputed, 1.0);
    const analysis::ExportOutcome outcome =
        analysis::export_bids(store, options.out, data, results);
    if (outcome.samples)
      return {.what = "a BIDS data set with motion", .problems = outcome.problems};
    return {
        .what = std::string("a BIDS data set without motion") +
                (asked ? "; the study has no samples of its tasks" : "; --recordings adds it"),
        .problems = outcome.problems};
  }
  if (options.format == "hdf5") {
    const analysis::ExportOutcome outcome =
        analysis::export_hdf5(store, options.out, options.data);
    return {.what = "study.h5" + samples_text(outcome, true), .problems = outcome.problems};
  }
  if (options.format == "xdf") {
    const analysis::ExportOutcome outcome =
        analysis::export_xdf(store, options.out, options.data);
    return {.what = "an XDF file for each session" + samples_text(outcome, true),
            .problems = outcome.problems};
  }
  const analysis::ExportOutcome outcome =
      analysis::export_csv(store, options.out, options.data);
  return {.what = "tables and codebook.csv" + samples_text(outcome, asked),
          .problems = outcome.problems};
}

}  // namespace

StudyExport write_study_export(const core::StudyStore& store,
                               const StudyExportRequest& request) {
  require_results_open(store);
  StudyExportRequest filled = request;
  filled.data.program_version = JND_VERSION;
  std::map<std::string, experiments::Study> studies;
  filled.data.stage_names = [&](const core::SessionRow& session) {
    return stage_names_of(store, session, studies);
  };
  // A BIDS data set has the preregistration in its results.
  if (request.format != "bids" && kept_preregistration(store)) {
    filled.data.preregistration = preregistered_study(store, analysis::load_study(store));
  }
  std::string forgotten = noted_export(store, request.out, request.format, request.data.pilot);
  StudyExport written = export_as(store, filled);
  written.forgotten = std::move(forgotten);
  return written;
}

}  // namespace jnd::app
