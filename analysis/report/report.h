#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/data/study_data.h"
#include "analysis/movement/movement_analysis.h"
#include "analysis/report/figure_files.h"
#include "analysis/results/study_results.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

/// What a report is made of. Whether the study may be seen (double-blind ones) is the caller's.
struct ReportSource {
  const core::StudyStore& store;
  const StudyData& data;
  const StudyResults& results;
  ResultsOptions results_options;  ///< That the results were computed with.
  const MovementAnalysis& movement;
  std::string program_version;
  bool pilot = false;  ///< Pilot sessions are among the data.
};

struct ReportOptions {
  int jobs = 2;                   ///< Figures at once; the report is the same for any.
  std::filesystem::path gnuplot;  ///< Empty: no figures.
  std::filesystem::path browser;  ///< Makes the PDF; empty: none.
  /// Told how much is done, 0 to 1; what it throws ends the work, and nothing of it stays.
  std::function<void(double)> on_progress;
};

struct ReportOutcome {
  std::filesystem::path html;
  std::filesystem::path pdf;  ///< Empty if there is none.
  std::vector<Figure> figures;
  std::vector<DrawnFigure> drawn;     ///< In the order of `figures`.
  std::vector<std::string> problems;  ///< What is lacking, a sentence each; the rest is whole.
};

/// Throws `Error` if something is in this folder already: before minutes are spent on its
/// content.
void require_free_folder(const std::filesystem::path& folder);

/// Writes report.html, report.pdf and figures/ into a folder that is new or empty. The same
/// study gives the same bytes. Throws `Error`: folder not empty, not writable, disk full; then
/// nothing of the report stays. Not real time.
[[nodiscard]] ReportOutcome write_report(const ReportSource& source,
                                         const std::filesystem::path& folder,
                                         const ReportOptions& options);

/// The programs of this machine that a report can use: gnuplot; chromium or wkhtmltopdf.
[[nodiscard]] ReportOptions installed_report_tools();

/// Every figure that there are data for, in the order of the report.
[[nodiscard]] std::vector<Figure> figures_of(const ReportSource& source);

/// The report as one self-contained HTML document; `drawn` in the order of `figures`.
[[nodiscard]] std::string report_html(const ReportSource& source,
                                      const std::vector<Figure>& figures,
                                      const std::vector<DrawnFigure>& drawn);

}  // namespace jnd::analysis
