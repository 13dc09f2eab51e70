#include "app/results/study_report.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "analysis/data/study_data.h"
#include "analysis/results/inverted_answers.h"
#include "analysis/words/said.h"
#include "app/language/words.h"
#include "app/preregistration/deviations.h"
#include "app/results/measured_devices.h"
#include "app/results/noted_export.h"
#include "app/results/results_output.h"
#include "app/session/shipped_files.h"
#include "app/session/stored_session.h"
#include "core/error.h"

namespace jnd::app {
namespace {

using analysis::DeliveredReport;

/// What the devices delivered, if the sessions have stored what was measured of them.
std::optional<DeliveredReport> delivered_report(const core::StudyStore& store,
                                                const analysis::StudyData& as_commanded,
                                                const StudyReportRequest& request) {
  const MeasuredDevices devices = measured_devices(store, as_commanded);
  if (devices.parts.empty()) return std::nullopt;
  const bool leaves_out = request.leaves_out_inverted;
  const analysis::DeliveredStudy study =
      delivered_study(store, as_commanded, devices.parts, leaves_out);
  DeliveredReport delivered{.results = results_of_data(study.data, request.results),
                            .devices = measured_device_words(store, devices),
                            .num_trials = study.num_replaced,
                            .num_left_out = study.num_left_out};
  tell_device_part(delivered.results, store, as_commanded, devices, request.results,
                   leaves_out);
  return delivered;
}

}  // namespace

void write_reports_in(const std::string& language) {
  const std::vector<Language> all = languages_in(languages_folder());
  if (std::ranges::find(all, language, &Language::code) == all.end()) {
    std::string codes;
    for (const Language& one : all) codes += (codes.empty() ? "" : ", ") + one.code;
    throw core::Error("--language: expected one of " + codes + ", found \"" + language + "\"");
  }
  if (!begin_language(languages_folder(), language)) return analysis::speak({});
  analysis::speak({.code = language,
                   .words = [](const char* english) { return tr(english); },
                   .decimal_comma = writes_decimal_comma(language)});
}

StudyReport write_study_report(const StudyReportRequest& request) {
  // For many people the fits take most of the time, for recordings the movement.
  constexpr double kRead = 0.05, kComputed = 0.5, kMoved = 0.65;
  const core::StudyStore store(request.folder, core::StudyStore::Mode::kReadOnly);
  require_results_open(store);
  analysis::require_free_folder(request.out);
  core::tell(request.on_progress, 0.0);
  analysis::StudyData data = analysis::load_study(store, request.pilot);
  const std::optional<DeliveredReport> delivered = delivered_report(store, data, request);
  // What was set aside by hand is a deviation; what the analysis leaves out is none besides.
  analysis::PreregisteredStudy preregistration = preregistered_study(
      store, data, {.inverted_out = request.leaves_out_inverted, .with_pilots = request.pilot});
  if (request.leaves_out_inverted) analysis::leave_out_inverted(data);
  core::tell(request.on_progress, kRead);
  analysis::ResultsOptions results_options = request.results;
  results_options.on_progress = core::part_of(request.on_progress, kRead, kComputed);
  StudyReport report{.results = results_of_data(data, results_options), .outcome = {}};
  report.results.preregistration = std::move(preregistration);
  core::tell(request.on_progress, kComputed);
  const analysis::MovementAnalysis movement = analysis::analyse_movement(
      store, {.pilot = request.pilot,
              .jobs = request.jobs,
              .on_progress = core::part_of(request.on_progress, kComputed, kMoved)});
  analysis::ReportOptions options = analysis::installed_report_tools();
  options.jobs = request.jobs;
  options.on_progress = core::part_of(request.on_progress, kMoved, 1.0);
  const std::string forgotten = noted_export(store, request.out, "report", request.pilot);
  report.outcome = analysis::write_report({.store = store,
                                           .data = data,
                                           .results = report.results,
                                           .results_options = request.results,
                                           .movement = movement,
                                           .delivered = delivered ? &*delivered : nullptr,
                                           .program_version = JND_VERSION,
                                           .pilot = request.pilot},
                                          request.out, options);
  if (!forgotten.empty()) report.outcome.problems.push_back(forgotten);
  return report;
}

}  // namespace jnd::app
