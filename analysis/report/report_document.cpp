#include "analysis/report/report_document.h"

#include <utility>

#include "analysis/report/report_pdf.h"
#include "analysis/report/run_tool.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

/// Makes the folder, or checks that it is empty. It removes everything again unless `keep` is
/// called.
class OutputFolder {
 public:
  explicit OutputFolder(const fs::path& folder) : folder_(folder) {
    require_free_folder(folder);
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder, error))) {
      fs::create_directories(folder, error);
      is_new_ = !error;
    }
    if (!error) fs::create_directory(folder / "figures", error);
    if (error) {
      take_away();
      throw core::Error(folder.string() +
                        ": expected a folder that can be made and written to, found: " +
                        error.message() + "; choose another --out");
    }
  }
  ~OutputFolder() {
    if (!kept_) take_away();
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  void keep() noexcept { kept_ = true; }

 private:
  void take_away() const {
    std::error_code ignored;
    if (is_new_) {
      fs::remove_all(folder_, ignored);
      return;
    }
    for (const char* name :
         {"figures", "report.html", "report.pdf", "supplement.html", "supplement.pdf"}) {
      fs::remove_all(folder_ / name, ignored);
    }
  }

  fs::path folder_;
  bool is_new_ = false;
  bool kept_ = false;
};

}  // namespace

void require_free_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(folder, error))) return;
  if (fs::is_directory(folder, error) && fs::is_empty(folder, error) && !error) return;
  throw core::Error(
      folder.string() +
      ": expected a new or empty folder, found something else or something in it; "
      "nothing is overwritten, choose another --out");
}

ReportOptions installed_report_tools() {
  return {
      .gnuplot = find_tool({"gnuplot"}),
      .browser = find_tool({"chromium", "chromium-browser", "google-chrome", "wkhtmltopdf"})};
}

ReportOutcome write_document(ReportDocument document, const fs::path& folder,
                             const ReportOptions& options) {
  OutputFolder output(folder);
  ReportOutcome outcome{.html = folder / "report.html", .figures = std::move(document.figures)};
  const auto progress = [&](double done) {
    if (options.on_progress) options.on_progress(done);
  };
  outcome.drawn = write_figures(outcome.figures, folder / "figures",
                                {.simulated = document.simulated,
                                 .date_time_ns = document.date_time_ns,
                                 .jobs = options.jobs,
                                 .gnuplot = options.gnuplot,
                                 .on_progress = [&](double done) { progress(0.7 * done); }});
  if (options.gnuplot.empty()) {
    outcome.problems.emplace_back(
        "gnuplot is not installed, so the figures are not drawn: tables, scripts and data are "
        "whole; apt-get install gnuplot-nox and run it again");
  } else {
    for (const DrawnFigure& drawn : outcome.drawn) {
      if (drawn.problem.empty()) continue;
      outcome.problems.push_back("figure " + drawn.name + " is not drawn: " + drawn.problem);
    }
  }
  if (document.supplement) {
    outcome.supplement_html = folder / "supplement.html";
    write_text_file(outcome.supplement_html,
                    document.supplement(outcome.figures, outcome.drawn));
  }
  // This is written after everything except its prints, so that a folder with a report in it is
  // complete.
  write_text_file(outcome.html, document.html(outcome.figures, outcome.drawn));
  progress(0.75);
  if (options.browser.empty()) {
    outcome.problems.emplace_back(
        "neither chromium nor wkhtmltopdf is installed, so there is no report.pdf; report.html "
        "prints the same");
  } else {
    const auto print = [&](const fs::path& html) {
      fs::path pdf = fs::path(html).replace_extension(".pdf");
      const std::string problem =
          print_as_pdf(options.browser, html, pdf, document.date_time_ns);
      if (problem.empty()) return pdf;
      outcome.problems.push_back("there is no " + pdf.filename().string() + ": " + problem);
      return fs::path();
    };
    outcome.pdf = print(outcome.html);
    progress(0.85);
    if (document.supplement) outcome.supplement_pdf = print(outcome.supplement_html);
  }
  progress(1.0);
  output.keep();
  return outcome;
}

}  // namespace jnd::analysis
