#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/report/figure.h"
#include "analysis/report/figure_files.h"

namespace jnd::analysis {

struct ReportOptions {
  /// The number of figures drawn at once. The report does not depend on it.
  int jobs = 2;
  std::filesystem::path gnuplot;  ///< If empty, there are no figures.
  std::filesystem::path browser;  ///< The program that makes the PDF. If empty, there is none.
  /// Receives the share of the work that is done, 0 to 1. An exception from it ends the work,
  /// and nothing of it stays.
  std::function<void(double)> on_progress;
};

struct ReportOutcome {
  std::filesystem::path html;
  std::filesystem::path pdf;                              ///< Empty if there is none.
  std::filesystem::path supplement_html, supplement_pdf;  ///< Empty if there are none.
  std::vector<Figure> figures;
  std::vector<DrawnFigure> drawn;  ///< In the order of `figures`.
  /// What is missing, one sentence each. The rest is complete.
  std::vector<std::string> problems;
};

/// A report on any subject before it is written.
struct ReportDocument {
  std::vector<Figure> figures;
  bool simulated = false;         ///< If true, each figure and each table says so.
  std::int64_t date_time_ns = 0;  ///< The date in PDF files.
  /// Returns the whole document. The drawn figures are in the order of `figures`.
  using Html =
      std::function<std::string(const std::vector<Figure>&, const std::vector<DrawnFigure>&)>;
  Html html;
  Html supplement;  ///< Empty if the document has no supplement.
};

/// Throws `Error` if the folder already contains something, before time is spent on its
/// content.
void require_free_folder(const std::filesystem::path& folder);

/// Writes report.html, report.pdf, figures/ and, if there is a supplement, supplement.html and
/// supplement.pdf into a new or empty folder. The same document gives the same bytes. Throws
/// `Error` if the folder is not empty or not writable, or if the disk is full; nothing of the
/// report then stays. Not real time.
[[nodiscard]] ReportOutcome write_document(ReportDocument document,
                                           const std::filesystem::path& folder,
                                           const ReportOptions& options);

/// The programs on this machine that a report can use: gnuplot, and chromium or wkhtmltopdf.
[[nodiscard]] ReportOptions installed_report_tools();

}  // namespace jnd::analysis
