#pragma once

#include <string>
#include <vector>

#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// One figure, before it is drawn.
struct Figure {
  std::string name;     ///< Of its files, without ending: "group_d_psychometric".
  std::string section;  ///< Of the results it belongs to: "group_d", "movement".
  std::string title;
  std::string caption;  ///< What is drawn, error bars and counts included; plain text.
  std::string thesis;  ///< The figures of the thesis it answers: "Fig. 5 and D.23"; "" if none.
  double width_in = 6.6, height_in = 3.2;
  std::string plot;  ///< gnuplot, from after the terminal is set to before it is closed.
  std::vector<FigureTable> tables;
};

/// A figure's script, complete: run in the folder of its tables, gnuplot writes NAME.svg and
/// NAME.pdf. With `simulated` it says so on the figure.
[[nodiscard]] std::string gnuplot_script(const Figure& figure, bool simulated);

/// A text as gnuplot takes it, in quotes.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

}  // namespace jnd::analysis
