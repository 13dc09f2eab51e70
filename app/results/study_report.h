#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "analysis/report/report.h"
#include "analysis/results/study_results.h"

namespace jnd::app {

/// Makes the program write all further reports in this language, such as "de"; "en" is English.
/// Throws `Error`, which names the possible languages, if the program has no catalogue for it.
/// Call it while no other thread of the program runs.
void write_reports_in(const std::string& language);

struct StudyReportRequest {
  std::filesystem::path folder;  ///< The folder NAME.study.
  std::filesystem::path out;     ///< A new or empty folder.
  bool pilot = false;
  int jobs = 2;  ///< At least 1; the report is the same for any number.
  analysis::ResultsOptions results;
  /// Leaves out people who answer the wrong way round in a block.
  bool leaves_out_inverted = false;
  /// Told how much is done, 0 to 1. What it throws ends the work, and nothing of the report
  /// remains.
  std::function<void(double)> on_progress;
};

struct StudyReport {
  analysis::StudyResults results;
  analysis::ReportOutcome outcome;
};

/// Reads a study, computes everything, and writes its report with the programs that this
/// machine has. Refuses a double-blind study that nobody has unblinded. Throws as
/// `analysis::write_report` does. Not real time.
[[nodiscard]] StudyReport write_study_report(const StudyReportRequest& request);

}  // namespace jnd::app
