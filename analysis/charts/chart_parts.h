#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "analysis/charts/chart.h"
#include "analysis/charts/figure_source.h"

namespace jnd::analysis {

// What several kinds of charts share.

/// An axis of the block's quantity.
[[nodiscard]] ChartAxis quantity_chart_axis(const std::string& quantity,
                                            const std::string& label);

/// "k = 0.66, a = 0.67"
[[nodiscard]] std::string law_words(const std::optional<double>& k,
                                    const std::optional<double>& a);

/// Where a curve is sampled: the ends and points evenly between them.
[[nodiscard]] std::vector<double> even_grid(const AxisRange& range);

/// Of more people a band stands for their lines, which nobody tells apart.
inline constexpr std::size_t kMostLines = 40;

/// The middle 90 % of what people have at each x, with the median: columns `x`, "median",
/// "low", "high". At an x with a value of fewer than two people nothing.
[[nodiscard]] FigureTable spread_table(const std::string& name, const std::string& x,
                                       const std::map<double, std::vector<double>>& values);

/// Shows it. `legend`: "middle 90 % of ...".
[[nodiscard]] ChartSeries spread_series(std::size_t table, const std::string& x,
                                        const std::string& legend);

/// The values in a column of a table at each number of another one.
[[nodiscard]] std::map<double, std::vector<double>> values_by(const FigureTable& table,
                                                              const std::string& x,
                                                              const std::string& y);

/// Puts an estimate beside the chart: its value in words, the interval in words, the reason and
/// the cautions. `words`: "w = 0.31", "0.21 Pa s"; used where there is a value.
void add_value(Chart& chart, const std::optional<double>& value, const Interval& ci95,
               const std::string& reason, const std::vector<std::string>& cautions,
               const std::string& words);

}  // namespace jnd::analysis
