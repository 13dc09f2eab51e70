#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// Quartiles by linear interpolation; whiskers reach to the last value within 1.5 interquartile
/// ranges of the box (Tukey 1977).
struct BoxPlot {
  double median = 0.0, lower_quartile = 0.0, upper_quartile = 0.0;
  double lower_whisker = 0.0, upper_whisker = 0.0;
};

/// `values`: at least one, finite.
[[nodiscard]] BoxPlot box_plot_of(std::vector<double> values);

/// One box with the values it is of.
struct BoxGroup {
  std::string label;
  double position = 1.0;                               ///< On the x axis.
  std::vector<std::pair<std::string, double>> values;  ///< Participant or trial, and value.
};

/// One row a box; groups without values have none.
[[nodiscard]] FigureTable box_table(const std::string& name,
                                    const std::vector<BoxGroup>& groups);
/// One row a value, moved aside a little where several lie in one place.
[[nodiscard]] FigureTable box_values_table(const std::string& name,
                                           const std::vector<BoxGroup>& groups);
}  // namespace jnd::analysis
