#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "analysis/charts/chart.h"
#include "analysis/charts/figure_source.h"

namespace jnd::analysis {

// Functions that several kinds of charts share.

/// An axis of the block's quantity.
[[nodiscard]] ChartAxis quantity_chart_axis(const std::string& quantity,
                                            const std::string& label);

/// For example "k = 0.66, a = 0.67".
[[nodiscard]] std::string law_words(const std::optional<double>& k,
                                    const std::optional<double>& a);

/// The points at which a curve is sampled: both ends, and points evenly between them.
[[nodiscard]] std::vector<double> even_grid(const AxisRange& range);

/// With more people a band replaces their lines, which nobody could tell apart.
inline constexpr std::size_t kMostLines = 40;

/// The middle 90 % of people's values at each x, with the median, in the columns `x`, "median",
/// "low" and "high". There is no row for an x at which fewer than two people have a value.
[[nodiscard]] FigureTable spread_table(const std::string& name, const std::string& x,
                                       const std::map<double, std::vector<double>>& values);

/// The series that shows a spread table. `legend` is like "middle 90 % of ...".
[[nodiscard]] ChartSeries spread_series(std::size_t table, const std::string& x,
                                        const std::string& legend);

/// The values of column `y` at each number in column `x`.
[[nodiscard]] std::map<double, std::vector<double>> values_by(const FigureTable& table,
                                                              const std::string& x,
                                                              const std::string& y);

/// Puts an estimate beside the chart: its value, interval, reason and cautions. `words` is the
/// value in words, such as "w = 0.31" or "0.21 Pa s"; it is used only if there is a value.
void add_value(Chart& chart, const std::optional<double>& value, const Interval& ci95,
               const std::string& reason, const std::vector<std::string>& cautions,
               const std::string& words);

}  // namespace jnd::analysis
