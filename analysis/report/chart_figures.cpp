#include "analysis/report/chart_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "analysis/report/plot_parts.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

using Look = ChartSeries::Look;

std::string quoted_column(const std::string& column) { return "'" + column + "'"; }

/// For example "(column('series')==3 ? column('ratio') : NaN)".
std::string column_of(const ChartSeries& series, const std::string& column) {
  return series.series ? if_series(series.series_column, *series.series, column)
                       : quoted_column(column);
}

/// "'TABLE.csv' using ", or with "every ::20::39 " if the rows are known.
std::string from_rows(const FigureTable& table, const ChartSeries& series) {
  if (!series.rows) return from_table(table);
  const auto& [first, last] = *series.rows;
  return fmt::format("'{}.csv' every ::{}::{} using ", table.name, first, last);
}

/// For example "'intensity':(column('series')==3 ? column('ratio') : NaN)".
std::string columns_of(const ChartSeries& series) {
  return quoted_column(series.x) + ":" + column_of(series, series.y);
}

/// The end of a bar. If a row has no end, it is the point itself.
std::string end_of(const FigureTable& table, const std::string& column, const std::string& y) {
  const std::string place = std::to_string(table.place_of(column) + 1);
  return "(valid(" + place + ") ? column('" + column + "') : column('" + y + "'))";
}

std::string colour_of(const ChartSeries& series) {
  return " lt " + std::to_string(series.colour);
}

/// "'intensity':'low':'high'" for the rows of the series. A row without both ends is left out.
std::string band_columns(const ChartSeries& series) {
  return quoted_column(series.x) + ":" + column_of(series, series.low) + ":" +
         column_of(series, series.high);
}

/// The size of a point grows with its number of answers.
std::string size_of(const FigureTable& table, const ChartSeries& series) {
  return "(0.2+sqrt(column('" + series.size + "')/" +
         plot_number(std::max(largest_in(table, series.size), 1.0)) + "))";
}

std::string track_style(const ChartSeries& series, bool is_small) {
  return " with linespoints" + colour_of(series) +
         (is_small ? " lw 1 pt 7 ps 0.25" : " lw 1.4 pt 7 ps 0.6");
}

/// One part of a plot command.
std::string command_of(const ChartSet& set, const ChartSeries& series, bool is_small) {
  const std::string legend =
      series.legend.empty() ? "" : " title " + gnuplot_quoted(series.legend);
  if (series.look == Look::kIdentity) return "x with lines ls 12" + legend;
  const FigureTable& table = set.tables[series.table];
  const std::string data = from_rows(table, series) + columns_of(series);
  switch (series.look) {
    case Look::kCurve:
      return data + (is_small ? " with lines ls 11 lw 1.3" : " with lines ls 11") + legend;
    case Look::kOtherCurve:
      return data + (is_small ? " with lines lt 2 lw 1.3" : " with lines lt 2 lw 1.4 dt 2") +
             legend;
    case Look::kLaw:
      return data + " with lines" + colour_of(series) + " lw 2" + legend;
    case Look::kBeyond:
      return data + " with lines" + colour_of(series) + " lw 1 dt (1,3)" + legend;
    case Look::kFaintCurve:
      return data + " with lines ls 10";
    case Look::kBand:
      return from_rows(table, series) + band_columns(series) +
             " with filledcurves lc rgb '#56B4E9' fill transparent solid 0.25" + legend;
    case Look::kSpread:
      return from_rows(table, series) + band_columns(series) +
             " with filledcurves lc rgb '#BBBBBB' fill transparent solid 0.5" + legend;
    case Look::kAnswers: {
      const std::string& measured = series.has_bars_along_x ? series.x : series.y;
      return data + ":" + end_of(table, series.low, measured) + ":" +
             end_of(table, series.high, measured) + " with " +
             (series.has_bars_along_x ? "x" : "y") + "errorbars ls 11 lc rgb '#0072B2'" +
             (is_small ? " lw 1 pt 7 ps 0.4" : " ps 0.9") + legend;
    }
    case Look::kManyAnswers:
      if (is_small)
        return data + " with points ls 11 lc rgb '#0072B2' lw 1 pt 7 ps 0.4" + legend;
      return data + ":" + size_of(table, series) +
             " with points pt 7 ps variable lc rgb '#0072B2'" + legend;
    case Look::kMeans:
      return data + " with points" + colour_of(series) + " ps 0.75" + legend;
    case Look::kTrack:
      return data + track_style(series, is_small) + legend;
    case Look::kReversals:
      return data + " with points lt 5 pt 6 ps " + (is_small ? "0.55" : "0.9") + legend;
    case Look::kEverybodys:
      return data + " with linespoints ls 10 ps 0.4" + legend;
    case Look::kIdentity:
      break;
  }
  return "";
}

std::string plot_of(const ChartSet& set, const Chart& chart, bool is_small) {
  std::vector<std::string> commands;
  for (const ChartSeries& series : chart.series) {
    if (is_small && series.look == Look::kBand) continue;
    commands.push_back(command_of(set, series, is_small));
  }
  // Faint curves come last in the key, so that a reader begins with what the chart is about.
  for (const ChartSeries& series : chart.series) {
    if (series.look != Look::kFaintCurve || series.legend.empty()) continue;
    commands.push_back("keyentry with lines ls 10 title " + gnuplot_quoted(series.legend));
  }
  return fmt::format("plot {}", fmt::join(commands, ", "));
}

std::string line_of(const ChartLine& line, std::size_t number) {
  const std::string at = plot_number(line.at);
  const std::string style = line.kind == ChartLine::Kind::kValue ? "ls 11 lw 1" : "ls 12";
  const std::string end = line.until ? "first " + plot_number(*line.until) : "graph 1";
  return "  set arrow " + std::to_string(number) +
         (line.is_vertical ? " from first " + at + ",graph 0 to first " + at + "," + end
                           : " from graph 0,first " + at + " to " + end + ",first " + at) +
         " nohead " + style + "\n";
}

/// The lines of this chart. They remove the lines that an earlier panel left.
std::string lines_of(const Chart& chart, std::size_t most) {
  std::string lines;
  for (std::size_t i = 0; i < chart.lines.size(); ++i) {
    lines += line_of(chart.lines[i], i + 1);
  }
  for (std::size_t i = chart.lines.size(); i < most; ++i) {
    lines += "  unset arrow " + std::to_string(i + 1) + "\n";
  }
  return lines;
}

std::string axis_settings(const std::string& name, const ChartAxis& axis, bool is_small) {
  if (axis.is_proportion) {
    return "  set " + name + "range [-0.06:1.06]\n  set " + name +
           (is_small ? "tics 0.5 font small\n" : "tics 0.25\n");
  }
  std::string settings = axis.logarithmic ? "  set logscale " + name + "\n" : "";
  settings += "  set " + name + "range " + range_words(axis.range) + "\n";
  if (axis.logarithmic) return settings + log_tics(name, axis.range, is_small);
  return is_small ? settings + small_tics(name, axis.range) : settings;
}

/// The tables that these charts show, in their order.
std::vector<FigureTable> tables_of(const ChartSet& set, const Chart* first, const Chart* end) {
  std::set<std::size_t> used;
  for (const Chart* chart = first; chart != end; ++chart) {
    for (const ChartSeries& series : chart->series) {
      if (series.look != Look::kIdentity) used.insert(series.table);
    }
  }
  std::vector<FigureTable> tables;
  for (const std::size_t table : used) tables.push_back(set.tables[table]);
  return tables;
}

/// A figure with the words of the report's figure, whole or in panels.
template <typename Words>
Figure figure_of(const ChartSet& set, const Words& words) {
  return {.name = words.name,
          .section = set.section,
          .title = words.title,
          .caption = words.caption,
          .thesis = words.thesis};
}

std::string panel_title(const Chart& chart) {
  return chart.who + "   " + (chart.value.empty() ? said("no value") : chart.value);
}

/// The first and last row of each series of a table, by the number of the series.
using SeriesRows = std::map<int, std::pair<std::size_t, std::size_t>>;

/// The rows of those series whose rows stand together.
SeriesRows series_rows(const FigureTable& table) {
  const std::size_t at = table.place_of("series");
  SeriesRows rows;
  if (at >= table.columns.size()) return rows;
  std::set<int> scattered;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto& number = table.rows[i][at].number;
    if (!number) continue;
    const auto series = static_cast<int>(*number);
    const auto [found, is_new] = rows.try_emplace(series, i, i);
    if (!is_new && found->second.second + 1 != i) scattered.insert(series);
    found->second.second = i;
  }
  for (const int series : scattered) rows.erase(series);
  return rows;
}

/// A figure with the panels of some of the participants.
Figure panel_figure(const ChartSet& set, const PanelFigures& layout, std::size_t most_lines) {
  Figure figure = figure_of(set, layout);
  const PanelGrid grid{.num_columns = layout.num_columns,
                       .x_title = set.x.title,
                       .y_title = set.y.title,
                       .gap_x_in = layout.num_columns > 3 ? 0.3 : 0.35};
  std::vector<Panel> panels;
  for (const Chart& chart : set.participants) {
    Panel panel{.title = panel_title(chart), .before = lines_of(chart, most_lines)};
    if (panels.empty()) {
      panel.before += axis_settings("x", set.x, /*is_small=*/true) +
                      axis_settings("y", set.y, /*is_small=*/true);
    }
    panel.plot = plot_of(set, chart, /*is_small=*/true);
    panels.push_back(std::move(panel));
  }
  figure.height_in = grid_height_in(grid, panels.size(), layout.panel_in);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  const Chart* const charts = set.participants.data();
  figure.tables = tables_of(set, charts, charts + set.participants.size());
  return figure;
}

/// The part of a set that one figure shows: some of many participants, with tables that hold
/// only their rows. The work of all figures together then grows in proportion to the number of
/// people, not to its square. A table that a chart shows as a whole stays whole.
class ChartPage {
 public:
  ChartPage(const ChartSet& set, std::size_t first, std::size_t end, std::size_t number)
      : set_(set), number_(number) {
    page_.section = set.section;
    page_.x = set.x;
    page_.y = set.y;
    page_.tables.resize(set.tables.size());
    page_.participants.assign(set.participants.begin() + static_cast<std::ptrdiff_t>(first),
                              set.participants.begin() + static_cast<std::ptrdiff_t>(end));
  }

  /// `rows` holds, for each table, the rows of each series that stand together, by the number
  /// of the series.
  [[nodiscard]] ChartSet made(const std::vector<SeriesRows>& rows) {
    for (const Chart& chart : page_.participants) {
      for (const ChartSeries& series : chart.series) {
        if (series.look != Look::kIdentity && !is_of_some_rows(series, rows)) {
          whole_.insert(series.table);
        }
      }
    }
    for (const std::size_t table : whole_) page_.tables[table] = set_.tables[table];
    for (Chart& chart : page_.participants) {
      for (ChartSeries& series : chart.series) {
        if (series.look == Look::kIdentity || whole_.contains(series.table)) continue;
        take(series, rows[series.table]);
      }
    }
    return std::move(page_);
  }

 private:
  static bool is_of_some_rows(const ChartSeries& series, const std::vector<SeriesRows>& rows) {
    return series.series && series.series_column == "series" &&
           rows[series.table].contains(*series.series);
  }

  void take(ChartSeries& series, const SeriesRows& rows) {
    const FigureTable& from = set_.tables[series.table];
    FigureTable& to = page_.tables[series.table];
    const auto [first, last] = rows.at(*series.series);
    const auto [place, is_new] =
        places_.try_emplace({series.table, *series.series}, to.rows.size());
    if (is_new) {
      to.name = from.name + "_page_" + std::to_string(number_);
      to.columns = from.columns;
      to.rows.insert(to.rows.end(), from.rows.begin() + static_cast<std::ptrdiff_t>(first),
                     from.rows.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    }
    series.rows = {place->second, place->second + last - first};
    series.series.reset();
  }

  const ChartSet& set_;
  std::size_t number_;
  ChartSet page_;
  std::set<std::size_t> whole_;
  /// The index of the series' first row in the page.
  std::map<std::pair<std::size_t, int>, std::size_t> places_;
};

std::vector<Figure> panel_figures(const ChartSet& set, const PanelFigures& layout) {
  std::size_t most_lines = 0;
  for (const Chart& chart : set.participants) {
    most_lines = std::max(most_lines, chart.lines.size());
  }
  const std::size_t num = set.participants.size();
  const auto most = static_cast<std::size_t>(layout.most_panels);
  if (num == 0) return {};
  if (num <= most) return {panel_figure(set, layout, most_lines)};
  std::vector<SeriesRows> rows;
  for (const FigureTable& table : set.tables) rows.push_back(series_rows(table));
  std::vector<Figure> figures;
  for (std::size_t first = 0; first < num; first += most) {
    const std::size_t number = first / most + 1;
    ChartPage page(set, first, std::min(first + most, num), number);
    figures.push_back(panel_figure(page.made(rows), layout, most_lines));
    if (number > 1) figures.back().name += "_" + std::to_string(number);
  }
  return figures;
}

/// Linear axes from zero to the ends of the logarithmic ones.
ChartSet on_linear_axes(const ChartSet& set) {
  ChartSet linear{.x = set.x, .y = set.y, .tables = set.tables};
  linear.x.logarithmic = linear.y.logarithmic = false;
  linear.x.range.low = -0.02 * set.x.range.high;
  linear.y.range.low = 0.0;
  return linear;
}

/// The chart on linear axes, and beside it the chart on its own axes.
std::string plot_on_both_axes(const ChartSet& set, const WholeFigure& layout,
                              const Chart& chart) {
  const PanelGrid grid{.num_columns = 2,
                       .x_title = set.x.title,
                       .y_title = set.y.title,
                       .top_in = 0.62,
                       .gap_x_in = 0.55};
  const ChartSet linear = on_linear_axes(set);
  Chart without_legend = chart;
  for (ChartSeries& series : without_legend.series) series.legend.clear();
  const std::string key =
      "  set key at screen 0.5,0.99 center top vertical reverse Left samplen 3 font small\n";
  return grid_plot(grid,
                   {{.title = "",
                     .before = key + axis_settings("x", linear.x, /*is_small=*/false) +
                               axis_settings("y", linear.y, /*is_small=*/false),
                     .plot = plot_of(linear, chart, /*is_small=*/false)},
                    {.title = "",
                     .before = axis_settings("x", set.x, /*is_small=*/false) +
                               axis_settings("y", set.y, /*is_small=*/false),
                     .plot = plot_of(set, without_legend, /*is_small=*/false)}},
                   layout.width_in, layout.height_in);
}

Figure whole_figure(const ChartSet& set, const WholeFigure& layout, const Chart& chart) {
  Figure figure = figure_of(set, layout);
  figure.width_in = layout.width_in;
  figure.height_in = layout.height_in;
  figure.tables = tables_of(set, &chart, &chart + 1);
  if (layout.has_linear_beside) {
    figure.plot = plot_on_both_axes(set, layout, chart);
    return figure;
  }
  figure.plot =
      axis_settings("x", set.x, /*is_small=*/false) +
      axis_settings("y", set.y, /*is_small=*/false) + "  set xlabel " +
      gnuplot_quoted(set.x.title) + "\n  set ylabel " + gnuplot_quoted(set.y.title) +
      (layout.has_key_above ? "\n  set key outside top center reverse Left samplen 2\n"
                            : "\n  set key top left reverse Left samplen 2\n") +
      lines_of(chart, chart.lines.size()) + "  " + plot_of(set, chart, /*is_small=*/false) +
      "\n";
  return figure;
}

}  // namespace

std::vector<Figure> chart_figures(const std::vector<ChartSet>& charts) {
  std::vector<Figure> figures;
  for (const ChartSet& set : charts) {
    if (set.whole && set.everybody) {
      figures.push_back(whole_figure(set, *set.whole, *set.everybody));
    }
    if (!set.panels) continue;
    for (Figure& figure : panel_figures(set, *set.panels)) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace jnd::analysis
