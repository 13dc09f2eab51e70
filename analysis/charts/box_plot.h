#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// Quartiles by linear interpolation. The whiskers reach to the last value within 1.5
/// interquartile ranges of the box (Tukey 1977).
struct BoxPlot {
  double median = 0.0, lower_quartile = 0.0, upper_quartile = 0.0;
  double lower_whisker = 0.0, upper_whisker = 0.0;
};

/// `values` holds at least one value, all finite.
[[nodiscard]] BoxPlot box_plot_of(std::vector<double> values);

/// One box and its values.
struct BoxGroup {
  std::string label;
  double position = 1.0;  ///< The position on the x axis.
  /// The participant or trial, and the value.
  std::vector<std::pair<std::string, double>> values;
};

/// A table with one row for each box. Groups without values have no row.
[[nodiscard]] FigureTable box_table(const std::string& name,
                                    const std::vector<BoxGroup>& groups);
/// A table with one row for each value. Values at the same place are moved aside a little.
[[nodiscard]] FigureTable box_values_table(const std::string& name,
                                           const std::vector<BoxGroup>& groups);
}  // namespace jnd::analysis
