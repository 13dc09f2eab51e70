#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "analysis/report/report.h"
#include "analysis/results/study_results.h"

namespace jnd::app {

/// Has all reports that follow written in this language ("de"), of which the program has a
/// catalogue; "en" is English. Throws `Error` for any other, naming those that there are. While
/// no other thread of the program runs.
void write_reports_in(const std::string& language);

struct StudyReportRequest {
  std::filesystem::path folder;  ///< NAME.study
  std::filesystem::path out;     ///< New or empty.
  bool pilot = false;
  int jobs = 2;  ///< >= 1; the report is the same for any.
  analysis::ResultsOptions results;
  bool leaves_out_inverted = false;  ///< Those who answer the wrong way round in a block.
  /// Told how much is done, 0 to 1; what it throws ends the work, and nothing of it stays.
  std::function<void(double)> on_progress;
};

struct StudyReport {
  analysis::StudyResults results;
  analysis::ReportOutcome outcome;
};

/// Reads a study, computes everything and writes its report with the programs that this machine
/// has. Refuses a double-blind study that nobody has unblinded; throws as
/// `analysis::write_report`. Not real time.
[[nodiscard]] StudyReport write_study_report(const StudyReportRequest& request);

}  // namespace jnd::app
