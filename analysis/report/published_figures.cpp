#include <algorithm>
#include <cmath>

#include "analysis/report/figures.h"
#include "analysis/report/plot_parts.h"
#include "analysis/report/predictive_figure.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

/// An arrow for each end of an interval that lies outside the axis.
std::string cut_ends(const FigureTable& table, const AxisRange& axis) {
  std::string arrows;
  int number = 20;
  for (const std::vector<FigureCell>& row : table.rows) {
    const std::string y = "first " + plot_number(*row[0].number);
    const std::string from = "first " + plot_number(*row[4].number) + "," + y;
    const std::string style = std::string(" head filled size screen 0.008,25 lw 1 lc rgb ") +
                              (*row[7].number > 0.5 ? "'#0072B2'" : "'#D55E00'") + "\n";
    if (*row[5].number < axis.low) {
      arrows += "  set arrow " + std::to_string(number++) + " from " + from + " to graph 0," +
                y + style;
    }
    if (*row[6].number > axis.high) {
      arrows += "  set arrow " + std::to_string(number++) + " from " + from + " to graph 1," +
                y + style;
    }
  }
  return arrows;
}

}  // namespace

std::vector<Figure> published_figures(const FigureSource& source) {
  if (std::optional<Figure> simulated = predictive_figure(source.results)) {
    return {std::move(*simulated)};
  }
  FigureTable table{.name = "published_ratios",
                    .columns = {"position", "estimate", "value", "published", "ratio",
                                "ratio_low", "ratio_high", "held_out"}};
  std::vector<std::string> names;
  std::vector<double> ratios;
  constexpr double kLowest = 0.05;  // The lower end that replaces an open one.
  constexpr double kHighest = 20.0;
  for (const ResultsSection& section : source.results.sections) {
    for (const Estimate& estimate : section.estimates) {
      if (!estimate.value || !estimate.published) continue;
      const double ratio = *estimate.value / *estimate.published;
      if (!std::isfinite(ratio) || ratio <= 0.0) continue;
      const auto end = [&](const std::optional<double>& value, double open) {
        const double scaled = value ? *value / *estimate.published : open;
        return scaled > 0.0 ? scaled : open;
      };
      const bool has_interval = estimate.ci95.low || estimate.ci95.high;
      const double low = has_interval ? end(estimate.ci95.low, kLowest) : ratio;
      const double high = has_interval ? end(estimate.ci95.high, kHighest) : ratio;
      names.push_back(estimate.name);
      ratios.insert(ratios.end(),
                    {ratio, std::max(low, ratio / 4.0), std::min(high, ratio * 4.0)});
      table.rows.push_back({static_cast<int>(names.size()), estimate.name, estimate.value,
                            estimate.published, ratio, low, high,
                            estimate.calibrated || estimate.implied ? 0 : 1});
    }
  }
  if (names.empty()) return {};
  ratios.push_back(1.0);
  const AxisRange axis = axis_range(ratios, /*logarithmic=*/true);
  const std::string arrows = cut_ends(table, axis);
  const auto count = static_cast<double>(names.size());
  Figure figure{.name = "published",
                .section = "",
                .title = said("Ours over published"),
                .height_in = 1.0 + 0.2 * count};
  figure.plot =
      "  set lmargin at screen 0.44\n  set rmargin at screen 0.97\n"
      "  set tmargin 2.5\n" +
      std::string("  set logscale x\n  set xrange ") + range_words(axis) + "\n  set yrange [" +
      plot_number(count + 0.7) + ":0.3]\n" + named_tics("y", names, false) +
      "  set ytics font small\n"
      "  set xtics (0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 10)\n"
      "  set xlabel " +
      gnuplot_quoted(said("Estimate over published value")) +
      "\n"
      "  set arrow 1 from 1,graph 0 to 1,graph 1 nohead ls 12\n"
      "  set bars 0.6\n" +
      arrows + "  plot ";
  const auto part = [&](int held_out, const char* type) {
    return from_table(table) + "(column('held_out')==" + std::to_string(held_out) +
           " ? column('ratio') : NaN):'position':'ratio_low':'ratio_high' with xerrorbars lt " +
           type + " dt 1 ps 0.8";
  };
  if (source.results.simulated) {
    figure.plot =
        "  set key at screen 0.7,0.985 center top vertical maxrows 1 reverse Left samplen 1\n" +
        figure.plot + part(1, "1") + " title " + gnuplot_quoted(said("held out")) + ", " +
        part(0, "2") + " title " + gnuplot_quoted(said("calibrated or implied")) + "\n";
    figure.caption = said(
        "With 95 % intervals. Circles: nothing of the published value went into the simulated "
        "laboratory; squares: it was calibrated on it, or the value follows from one that "
        "was. ");
  } else {
    figure.plot += part(1, "1") + "\n";
    figure.caption = said("With 95 % intervals. ");
  }
  figure.caption += said("At 1 ours and the published value agree.");
  figure.caption += said(" The published value's own error is not drawn.");
  if (!arrows.empty())
    figure.caption += said(" An arrow: the interval goes on beyond the axis.");
  figure.tables = {std::move(table)};
  return {std::move(figure)};
}

}  // namespace jnd::analysis
