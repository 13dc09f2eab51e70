#pragma once

#include <string>
#include <vector>

#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// One figure before it is drawn.
struct Figure {
  /// The name of its files without extension, such as "group_d_psychometric".
  std::string name;
  /// The section of the results to which it belongs, such as "group_d" or "movement".
  std::string section;
  std::string title;
  std::string caption;  ///< What is drawn, including error bars and counts. Plain text.
  /// The figures of the thesis to which it corresponds, such as "Fig. 5 and D.23"; "" if none.
  std::string thesis;
  double width_in = 6.6, height_in = 3.2;
  std::string plot;  ///< The gnuplot commands between setting the terminal and closing it.
  std::vector<FigureTable> tables;
};

/// The complete script of a figure. If gnuplot runs it in the folder of its tables, it writes
/// NAME.svg and NAME.pdf. With `simulated` the figure says so.
[[nodiscard]] std::string gnuplot_script(const Figure& figure, bool simulated);

/// A text in quotes for gnuplot.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

}  // namespace jnd::analysis
