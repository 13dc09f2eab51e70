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
  int jobs = 2;                   ///< Figures at once; the report is the same for any.
  std::filesystem::path gnuplot;  ///< Empty: no figures.
  std::filesystem::path browser;  ///< Makes the PDF; empty: none.
  /// Told how much is done, 0 to 1; what it throws ends the work, and nothing of it stays.
  std::function<void(double)> on_progress;
};

struct ReportOutcome {
  std::filesystem::path html;
  std::filesystem::path pdf;                              ///< Empty if there is none.
  std::filesystem::path supplement_html, supplement_pdf;  ///< Empty if there is none.
  std::vector<Figure> figures;
  std::vector<DrawnFigure> drawn;     ///< In the order of `figures`.
  std::vector<std::string> problems;  ///< What is lacking, a sentence each; the rest is whole.
};

/// A report before it is written, whatever it is about.
struct ReportDocument {
  std::vector<Figure> figures;
  bool simulated = false;         ///< Each figure and each table says so.
  std::int64_t date_time_ns = 0;  ///< What PDF files give as their date.
  /// The whole document; drawn figures in the order of `figures`.
  using Html =
      std::function<std::string(const std::vector<Figure>&, const std::vector<DrawnFigure>&)>;
  Html html;
  Html supplement;  ///< Empty: the document has none.
};

/// Throws `Error` if something is in this folder already: before minutes are spent on its
/// content.
void require_free_folder(const std::filesystem::path& folder);

/// Writes report.html, report.pdf, figures/ and what there is of supplement.html and
/// supplement.pdf into a folder that is new or empty. The same
/// document gives the same bytes. Throws `Error`: folder not empty, not writable, disk full;
/// then nothing of the report stays. Not real time.
[[nodiscard]] ReportOutcome write_document(ReportDocument document,
                                           const std::filesystem::path& folder,
                                           const ReportOptions& options);

/// The programs of this machine that a report can use: gnuplot; chromium or wkhtmltopdf.
[[nodiscard]] ReportOptions installed_report_tools();

}  // namespace jnd::analysis
