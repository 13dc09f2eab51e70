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

/// The data of a figure, which a CSV file beside it holds.
struct FigureTable {
  std::string name;  ///< The name of the file without ".csv", unique in a report.
  std::vector<std::string> columns;
  std::vector<std::vector<FigureCell>> rows;

  /// The index of a column; the number of columns if there is none of this name.
  [[nodiscard]] std::size_t place_of(const std::string& column) const;
};

/// The text with only letters, digits and underscores, for names of files.
[[nodiscard]] std::string file_word(const std::string& text);

}  // namespace jnd::analysis
