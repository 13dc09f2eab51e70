#include "analysis/charts/chart_parts.h"

#include <algorithm>

#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"
#include "experiments/study/media.h"

namespace jnd::analysis {

ChartAxis quantity_chart_axis(const std::string& quantity, const std::string& label) {
  return {.title = quantity_axis(quantity),
          .label = label + " " + said_of(experiments::quantity_words(quantity)),
          .unit = experiments::quantity_unit(quantity)};
}

std::string law_words(const std::optional<double>& k, const std::optional<double>& a) {
  return "k = " + number_words(k, 3) + ", a = " + number_words(a, 3);
}

std::vector<double> even_grid(const AxisRange& range) {
  constexpr int kSteps = 160;
  std::vector<double> grid;
  for (int i = 0; i <= kSteps; ++i) {
    grid.push_back(range.low + (range.high - range.low) * i / kSteps);
  }
  return grid;
}

FigureTable spread_table(const std::string& name, const std::string& x,
                         const std::map<double, std::vector<double>>& values) {
  constexpr double kLow = 0.05, kHigh = 0.95;
  FigureTable table{.name = name, .columns = {x, "median", "low", "high"}};
  for (const auto& [at, of_people] : values) {
    if (of_people.size() < 2) continue;
    std::vector<double> ascending = of_people;
    std::ranges::sort(ascending);
    table.rows.push_back({at, percentile(ascending, 0.5), percentile(ascending, kLow),
                          percentile(ascending, kHigh)});
  }
  return table;
}

ChartSeries spread_series(std::size_t table, const std::string& x, const std::string& legend) {
  return {.look = ChartSeries::Look::kSpread,
          .table = table,
          .x = x,
          .y = "median",
          .low = "low",
          .high = "high",
          .legend = legend};
}

std::map<double, std::vector<double>> values_by(const FigureTable& table, const std::string& x,
                                                const std::string& y) {
  const std::size_t x_at = table.place_of(x), y_at = table.place_of(y);
  std::map<double, std::vector<double>> values;
  for (const std::vector<FigureCell>& row : table.rows) {
    if (row[x_at].number && row[y_at].number) {
      values[*row[x_at].number].push_back(*row[y_at].number);
    }
  }
  return values;
}

void add_value(Chart& chart, const std::optional<double>& value, const Interval& ci95,
               const std::string& reason, const std::vector<std::string>& cautions,
               const std::string& words) {
  for (const std::string& caution : cautions) {
    chart.caution += (chart.caution.empty() ? "" : "; ") + caution;
  }
  if (!value) {
    chart.reason = reason.empty() ? said("no value") : reason;
    return;
  }
  chart.value = words;
  if (ci95.low || ci95.high) chart.detail = "95 % " + interval_words(ci95, value);
}

}  // namespace jnd::analysis
