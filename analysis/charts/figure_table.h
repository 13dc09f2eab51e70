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

  /// The place of a column in the rows; that behind the last one where there is none.
  [[nodiscard]] std::size_t place_of(const std::string& column) const;
};

/// Letters, digits and underscores alone, for names of files.
[[nodiscard]] std::string file_word(const std::string& text);

}  // namespace jnd::analysis
