#include "analysis/report/box_plot.h"

#include <algorithm>

#include "analysis/report/plot_parts.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {

BoxPlot box_plot_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  BoxPlot box{.median = percentile(values, 0.5),
              .lower_quartile = percentile(values, 0.25),
              .upper_quartile = percentile(values, 0.75)};
  constexpr double kReach = 1.5;  // Tukey 1977
  const double reach = kReach * (box.upper_quartile - box.lower_quartile);
  // The quartiles lie between values within reach, so there is always one.
  box.lower_whisker =
      *std::lower_bound(values.begin(), values.end(), box.lower_quartile - reach);
  box.upper_whisker =
      *std::prev(std::upper_bound(values.begin(), values.end(), box.upper_quartile + reach));
  return box;
}

FigureTable box_table(const std::string& name, const std::vector<BoxGroup>& groups) {
  FigureTable table{.name = name,
                    .columns = {"position", "label", "lower_whisker", "lower_quartile",
                                "median", "upper_quartile", "upper_whisker", "n"}};
  for (const BoxGroup& group : groups) {
    if (group.values.empty()) continue;
    std::vector<double> values;
    for (const auto& [who, value] : group.values) values.push_back(value);
    const BoxPlot box = box_plot_of(values);
    table.rows.push_back({group.position, group.label, box.lower_whisker, box.lower_quartile,
                          box.median, box.upper_quartile, box.upper_whisker,
                          static_cast<int>(values.size())});
  }
  return table;
}

FigureTable box_values_table(const std::string& name, const std::vector<BoxGroup>& groups) {
  FigureTable table{.name = name,
                    .columns = {"position", "label", "participant", "value", "aside"}};
  for (const BoxGroup& group : groups) {
    int place = 0;
    for (const auto& [who, value] : group.values) {
      // -1, 0, 1 in turn: by their order, so that the picture is the same every time.
      table.rows.push_back({group.position, group.label, who, value, place++ % 3 - 1});
    }
  }
  return table;
}

std::string box_plot_commands(const FigureTable& boxes, const FigureTable& values,
                              double width) {
  const std::string box_width = ":(" + plot_number(width) + ")";
  return from_table(boxes) +
         "'position':'lower_quartile':'lower_whisker':'upper_whisker':" + "'upper_quartile'" +
         box_width + " with candlesticks lc rgb '#333333' lw 1.2 fill empty whiskerbars 0.5, " +
         from_table(boxes) + "'position':'median':'median':'median':'median'" + box_width +
         " with candlesticks lc rgb '#D55E00' lw 2.5 dt 1 fill empty, " + from_table(values) +
         "(column('position')+" + plot_number(0.12 * width) +
         "*column('aside')):'value' with points pt 6 ps 0.45 lc rgb '#0072B2'";
}

}  // namespace jnd::analysis
