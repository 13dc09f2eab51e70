#include "analysis/charts/chart_parts.h"

#include "analysis/results/number_words.h"
#include "experiments/study/media.h"

namespace jnd::analysis {

ChartAxis quantity_chart_axis(const std::string& quantity, const std::string& label) {
  return {.title = quantity_axis(quantity),
          .label = label + " " + experiments::quantity_words(quantity),
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

void add_value(Chart& chart, const std::optional<double>& value, const Interval& ci95,
               const std::string& reason, const std::vector<std::string>& cautions,
               const std::string& words) {
  for (const std::string& caution : cautions) {
    chart.caution += (chart.caution.empty() ? "" : "; ") + caution;
  }
  if (!value) {
    chart.reason = reason.empty() ? "no value" : reason;
    return;
  }
  chart.value = words;
  if (ci95.low || ci95.high) chart.detail = "95 % " + interval_words(ci95, value);
}

}  // namespace jnd::analysis
