#pragma once

#include <filesystem>

#include "analysis/report/figure.h"

namespace jnd::analysis {

/// Throws `core::Error` unless a figure can be written there: a name that ends in .svg, .pdf or
/// .png, in a folder that exists, and nothing of that name yet.
void require_figure_file(const std::filesystem::path& file);

/// Draws one figure into one new file, by gnuplot. Throws `core::Error` as
/// `require_figure_file`, and where gnuplot is not installed or cannot draw it. Not real time.
void write_single_figure(const Figure& figure, const std::filesystem::path& file);

}  // namespace jnd::analysis
