#include "analysis/charts/box_plot.h"

#include <algorithm>

#include "analysis/statistics/summary.h"

namespace jnd::analysis {

BoxPlot box_plot_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  BoxPlot box{.median = percentile(values, 0.5),
              .lower_quartile = percentile(values, 0.25),
              .upper_quartile = percentile(values, 0.75)};
  constexpr double kReach = 1.5;  // Tukey 1977
  const double reach = kReach * (box.upper_quartile - box.lower_quartile);
  // Each quartile lies between values within reach, so there is always one.
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
      // The shifts -1, 0, 1 follow the order of the values, so the picture is the same every
      // time.
      table.rows.push_back({group.position, group.label, who, value, place++ % 3 - 1});
    }
  }
  return table;
}

}  // namespace jnd::analysis
