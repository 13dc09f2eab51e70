#pragma once

#include <filesystem>

#include "analysis/report/figure.h"

namespace jnd::analysis {

/// Throws `core::Error` unless a figure can be written there: the name must end in .svg, .pdf
/// or .png, the folder must exist, and nothing of that name may exist.
void require_figure_file(const std::filesystem::path& file);

/// Draws one figure into one new file by gnuplot. Throws `core::Error` as `require_figure_file`
/// does, and if gnuplot is not installed or cannot draw the figure. Not real time.
void write_single_figure(const Figure& figure, const std::filesystem::path& file);

}  // namespace jnd::analysis
