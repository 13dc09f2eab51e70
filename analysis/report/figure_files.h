#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/report/figure.h"

namespace jnd::analysis {

/// One figure, drawn.
struct DrawnFigure {
  std::string name;
  std::string svg;      ///< The file's text; "" if it could not be drawn.
  std::string problem;  ///< Why not; "" if it was.
};

struct FigureOptions {
  bool simulated = false;         ///< Each figure and each table says so.
  std::int64_t date_time_ns = 0;  ///< What PDF files give as their date.
  int jobs = 2;                   ///< Figures at once, >= 1; the files are the same for any.
  std::filesystem::path gnuplot;  ///< Empty: scripts and tables alone.
  /// Told how much is done, 0 to 1, from any of the jobs; what it throws ends the drawing.
  std::function<void(double)> on_progress;
};

/// Writes NAME.gp and its tables for each figure, and draws NAME.svg and NAME.pdf. The same
/// figures give the same bytes. Throws `Error` for what cannot be written; a figure that cannot
/// be drawn is told in its `problem` and does not keep the others. Not real time.
[[nodiscard]] std::vector<DrawnFigure> write_figures(const std::vector<Figure>& figures,
                                                     const std::filesystem::path& folder,
                                                     const FigureOptions& options);

/// Puts this moment in place of the dates in a PDF, which keeps its length; one that was
/// written without compressing them, as cairo and Chromium do. Throws `Error` for what cannot
/// be written.
void set_pdf_dates(const std::filesystem::path& file, std::int64_t time_ns);

/// Writes a text file as a whole. Throws `Error` naming it: not writable, disk full.
void write_text_file(const std::filesystem::path& file, const std::string& text);

}  // namespace jnd::analysis
