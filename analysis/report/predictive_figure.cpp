#include "analysis/report/predictive_figure.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/report/plot_parts.h"
#include "analysis/results/number_words.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

constexpr int kBins = 30;

/// A shorter name for the title of a panel.
std::string panel_title(std::string name) {
  for (const auto& [long_word, short_word] :
       {std::pair<std::string, std::string>{"weber_fraction", "w"}, {"_m_per_s", ""}}) {
    const std::size_t at = name.find(long_word);
    if (at != std::string::npos) name.replace(at, long_word.size(), short_word);
  }
  return name;
}

/// Whether all values are whole, such as counts of people.
bool are_whole(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return value == std::floor(value); });
}

/// The range of a panel. It leaves out the outermost hundredth of the studies, and values
/// farther out than three times the interquartile range, because a nearly flat curve of one
/// person can make a mean arbitrarily large. It includes both points.
AxisRange range_of(const Estimate& estimate) {
  std::vector<double> ascending = estimate.predictive->values;
  std::ranges::sort(ascending);
  std::vector<double> kept = {*estimate.published};
  if (estimate.value) kept.push_back(*estimate.value);
  const double first = percentile(ascending, 0.25), third = percentile(ascending, 0.75);
  const double reach = 3.0 * (third - first);
  kept.push_back(std::max(percentile(ascending, 0.005), first - reach));
  kept.push_back(std::min(percentile(ascending, 0.995), third + reach));
  std::erase_if(kept, [](double value) { return !std::isfinite(value); });
  if (!are_whole(estimate.predictive->values)) return axis_range(kept);
  return {std::floor(*std::ranges::min_element(kept)) - 0.5,
          std::ceil(*std::ranges::max_element(kept)) + 0.5};
}

/// Adds the counts in each bin, as shares of the fullest bin. Whole numbers have one bin each.
void add_bins(FigureTable& table, int series, const Estimate& estimate,
              const AxisRange& range) {
  const bool is_whole = are_whole(estimate.predictive->values);
  const double width = is_whole ? 1.0 : (range.high - range.low) / kBins;
  std::map<int, double> counts;
  double most = 0.0;
  for (const double value : estimate.predictive->values) {
    if (!std::isfinite(value) || value < range.low || value > range.high) continue;
    most = std::max(most, ++counts[static_cast<int>((value - range.low) / width)]);
  }
  for (const auto& [bin, count] : counts) {
    table.rows.push_back({series, estimate.name, range.low + (bin + 0.5) * width, width,
                          static_cast<int>(count), count / most});
  }
}

std::string caption_of(const Predictive& predictive) {
  return said(
      "Each panel: what {} simulated studies of {} come to by the statistic that was published "
      "(shape), the published value (point and line; circles held out, squares calibrated or "
      "implied), and this run (open triangle). Simulated studies far out of the panel are cut. "
      "Shares of them as far out stand in the table.",
      std::to_string(predictive.num_studies),
      counted_words(predictive.num_participants, "participant"));
}

}  // namespace

std::optional<Figure> predictive_figure(const StudyResults& results) {
  FigureTable bins{.name = "published_simulated",
                   .columns = {"series", "estimate", "value", "width", "num_studies", "share"}};
  FigureTable points{.name = "published_points",
                     .columns = {"series", "estimate", "published", "this_run", "tail",
                                 "tail_standard_error", "held_out", "height"}};
  std::vector<Panel> panels;
  constexpr double kPointHeight = 0.06;
  for (const ResultsSection& section : results.sections) {
    for (const Estimate& estimate : section.estimates) {
      if (!estimate.published || !estimate.predictive) continue;
      const int series = static_cast<int>(panels.size()) + 1;
      const bool held_out = !estimate.calibrated && !estimate.implied;
      const AxisRange range = range_of(estimate);
      add_bins(bins, series, estimate, range);
      points.rows.push_back({series, estimate.name, estimate.published, estimate.value,
                             estimate.predictive->tail, estimate.predictive->standard_error,
                             held_out ? 1 : 0, kPointHeight});
      const std::string published = from_table(points) + if_series(series, "published");
      panels.push_back(
          {.title = panel_title(estimate.name),
           .before = "  set xrange " + range_words(range) + "\n" + small_tics("x", range),
           .plot = "plot " + from_table(bins) + if_series(series, "value") +
                   ":'share':'width' with boxes fs solid 0.35 noborder lc rgb '#0072B2' "
                   "notitle, " +
                   published + ":(1.05) with impulses lc rgb '#D55E00' lw 1 notitle, " +
                   published + ":'height' with points lc rgb '#D55E00' pt " +
                   (held_out ? "7" : "5") + " ps 0.7 notitle, " + from_table(points) +
                   if_series(series, "this_run") +
                   ":'height' with points lc rgb 'black' pt 8 ps 0.7 notitle"});
    }
  }
  if (panels.empty()) return std::nullopt;
  const PanelGrid grid{.num_columns = 3,
                       .x_title = said("Value"),
                       .y_title = said("Share of simulated studies"),
                       .left_in = 0.4};
  Figure figure{.name = "published",
                .section = "",
                .title = said("Published values among simulated studies"),
                .caption = caption_of(results.predictive),
                .height_in = grid_height_in(grid, panels.size(), 0.75)};
  figure.plot = "  unset ytics\n  set yrange [0:1.15]\n  unset key\n" +
                grid_plot(grid, panels, figure.width_in, figure.height_in);
  figure.tables = {std::move(bins), std::move(points)};
  return figure;
}

}  // namespace jnd::analysis
