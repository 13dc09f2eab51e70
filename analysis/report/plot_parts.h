#pragma once

#include <string>
#include <vector>

#include "analysis/charts/axis_range.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

// Parts of gnuplot scripts that figures share. Columns are named as in the tables.

/// A number in the syntax of gnuplot; NaN if it is not finite.
[[nodiscard]] std::string plot_number(double value);

/// The text "'TABLE.csv' using ".
[[nodiscard]] std::string from_table(const FigureTable& table);

/// The largest number in a column of a table, and at least 0.
[[nodiscard]] double largest_in(const FigureTable& table, const std::string& column);

/// Selects the rows of a table with this number, such as "(column('series')==3 ? column('mean')
/// : NaN)".
[[nodiscard]] std::string if_series(const std::string& series_column, int series,
                                    const std::string& column);
[[nodiscard]] std::string if_series(int series, const std::string& column);

/// One of many similar panels, with a title and its own plot command.
struct Panel {
  std::string title;
  std::string before;  ///< Settings for this panel and those after it.
  std::string plot;    ///< The command "plot ..." on one line.
};

/// How wide a letter of the small font is on average.
inline constexpr double kSmallLetterIn = 0.065;

/// A text of one line as up to two lines of at most so many letters, broken between words. What
/// is longer ends with an ellipsis. A text that has line breaks already is left alone.
[[nodiscard]] std::string on_two_lines(const std::string& text, std::size_t most_letters);

/// At most so many letters; what is longer ends with an ellipsis.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t most_letters);

/// How many letters (code points) a text of UTF-8 has.
[[nodiscard]] std::size_t num_letters_of(const std::string& text);

/// Lays panels out in rows of `num_columns`, titles above, axis names outside. A title that is
/// wider than its panel stands on two lines.
struct PanelGrid {
  int num_columns = 4;
  std::string x_title, y_title;
  double left_in = 0.62, right_in = 0.12, top_in = 0.42, bottom_in = 0.55;
  double gap_x_in = 0.35, gap_y_in = 0.5;
};

/// The height of a figure whose panels are `panel_in` high.
[[nodiscard]] double grid_height_in(const PanelGrid& grid, std::size_t num_panels,
                                    double panel_in);
[[nodiscard]] std::string grid_plot(const PanelGrid& grid, const std::vector<Panel>& panels,
                                    double width_in, double height_in);

/// The text "[low:high]".
[[nodiscard]] std::string range_words(const AxisRange& range);

/// At most five tics at round numbers for a small panel, such as "set xtics 0.5 font small".
[[nodiscard]] std::string small_tics(const std::string& axis, const AxisRange& range);

/// Tics of a logarithmic axis, such as "set ytics (3.0, 5.0, 7.0) font small". There are three
/// to six round numbers, or at most four if the panel is small. gnuplot itself might label only
/// one. A narrow range has equal steps.
[[nodiscard]] std::string log_tics(const std::string& axis, const AxisRange& range,
                                   bool small = false);

/// Named tics, such as "set xtics ('P01' 1, 'P02' 2)". With `upright` they are rotated.
[[nodiscard]] std::string named_tics(const std::string& axis,
                                     const std::vector<std::string>& names, bool upright);

/// The arguments of "plot" for `box_table` and `box_values_table`. `width` is that of a box in
/// units of x.
[[nodiscard]] std::string box_plot_commands(const FigureTable& boxes, const FigureTable& values,
                                            double width);

}  // namespace jnd::analysis
