#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/report/figure.h"

namespace jnd::analysis {

/// A figure after drawing.
struct DrawnFigure {
  std::string name;
  std::string svg;      ///< The text of the file; "" if it could not be drawn.
  std::string problem;  ///< Why it could not be drawn; "" if it was.
};

struct FigureOptions {
  bool simulated = false;         ///< If true, each figure and each table says so.
  std::int64_t date_time_ns = 0;  ///< The date in PDF files.
  /// The number of figures drawn at once, >= 1. The files do not depend on it.
  int jobs = 2;
  std::filesystem::path gnuplot;  ///< If empty, only scripts and tables are written.
  /// Receives the share of the work that is done, 0 to 1, from any of the jobs. An exception
  /// from it ends the drawing.
  std::function<void(double)> on_progress;
};

/// Writes NAME.gp and the tables of each figure, and draws NAME.svg and NAME.pdf. The same
/// figures give the same bytes. Throws `Error` if something cannot be written. A figure that
/// cannot be drawn reports it in `problem` and does not stop the others. Not real time.
[[nodiscard]] std::vector<DrawnFigure> write_figures(const std::vector<Figure>& figures,
                                                     const std::filesystem::path& folder,
                                                     const FigureOptions& options);

/// Replaces the dates in a PDF by this time without changing its length. The PDF must contain
/// its dates uncompressed, as those of cairo and Chromium do. Throws `Error` if it cannot be
/// written.
void set_pdf_dates(const std::filesystem::path& file, std::int64_t time_ns);

/// Writes a whole text file. Throws `Error` that names it if it is not writable or the disk is
/// full.
void write_text_file(const std::filesystem::path& file, const std::string& text);

}  // namespace jnd::analysis
