#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// A number, a text, or nothing.
struct FigureCell {
  FigureCell() = default;
  FigureCell(double value) : number(value) {}                 // NOLINT: cells are values
  FigureCell(int value) : number(value) {}                    // NOLINT
  FigureCell(std::optional<double> value) : number(value) {}  // NOLINT
  FigureCell(std::string value) : text(std::move(value)) {}   // NOLINT
  FigureCell(const char* value) : text(value) {}              // NOLINT

  std::optional<double> number;
  std::string text;
};

/// What a figure is drawn from: one CSV file beside it.
struct FigureTable {
  std::string name;  ///< Of the file, without ".csv"; unique in a report.
  std::vector<std::string> columns;
  std::vector<std::vector<FigureCell>> rows;
};

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

/// Letters, digits and underscores alone, for names of files.
[[nodiscard]] std::string file_word(const std::string& text);

}  // namespace jnd::analysis
