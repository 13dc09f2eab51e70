#include "analysis/report/chart_figures.h"

#include <algorithm>
#include <set>

#include "analysis/report/plot_parts.h"

namespace jnd::analysis {
namespace {

using Look = ChartSeries::Look;

std::string quoted_column(const std::string& column) { return "'" + column + "'"; }

/// "'intensity':(column('series')==3 ? column('ratio') : NaN)"
std::string columns_of(const ChartSeries& series) {
  return quoted_column(series.x) + ":" +
         (series.series > 0 ? if_series(series.series, series.y) : quoted_column(series.y));
}

/// The end of a bar; that of a row without one is the point itself.
std::string end_of(const FigureTable& table, const std::string& column, const std::string& y) {
  const std::string place = std::to_string(table.place_of(column) + 1);
  return "(valid(" + place + ") ? column('" + column + "') : column('" + y + "'))";
}

std::string track_style(const ChartSeries& series, bool is_small) {
  return " with linespoints lt " + std::to_string(series.colour) +
         (is_small ? " lw 1 pt 7 ps 0.25" : " lw 1.4 pt 7 ps 0.6");
}

/// One part of a plot command.
std::string command_of(const ChartSet& set, const ChartSeries& series, bool is_small) {
  const std::string legend =
      series.legend.empty() ? "" : " title " + gnuplot_quoted(series.legend);
  if (series.look == Look::kIdentity) return "x with lines ls 12" + legend;
  const FigureTable& table = set.tables[series.table];
  const std::string data = from_table(table) + columns_of(series);
  switch (series.look) {
    case Look::kCurve:
      return data + (is_small ? " with lines ls 11 lw 1.3" : " with lines ls 11") + legend;
    case Look::kAnswers:
      return data + ":" + end_of(table, series.low, series.y) + ":" +
             end_of(table, series.high, series.y) + " with yerrorbars ls 11 lc rgb '#0072B2'" +
             (is_small ? " lw 1 pt 7 ps 0.4" : " ps 0.9") + legend;
    case Look::kManyAnswers:
      return data + " with points ls 11 lc rgb '#0072B2' lw 1 pt 7 ps " +
             (is_small ? "0.4" : "0.7") + legend;
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
  std::string plot = "plot ";
  for (const ChartSeries& series : chart.series) {
    plot += (&series == &chart.series.front() ? "" : ", ") + command_of(set, series, is_small);
  }
  return plot;
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

/// This chart's lines, and none that an earlier panel left.
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

Figure figure_of(const ChartSet& set) {
  return {.name = set.name,
          .section = set.section,
          .title = set.title,
          .caption = set.caption,
          .thesis = set.thesis};
}

std::string panel_title(const Chart& chart) {
  return chart.who + "   " + (chart.value.empty() ? "no value" : chart.value);
}

std::vector<Figure> panel_figures(const ChartSet& set) {
  std::vector<Figure> figures;
  std::size_t most_lines = 0;
  for (const Chart& chart : set.participants) {
    most_lines = std::max(most_lines, chart.lines.size());
  }
  const Chart* const charts = set.participants.data();
  const auto most = static_cast<std::size_t>(set.most_panels);
  for (std::size_t first = 0; first < set.participants.size(); first += most) {
    const std::size_t end = std::min(first + most, set.participants.size());
    Figure figure = figure_of(set);
    if (first > 0) figure.name += "_" + std::to_string(first / most + 1);
    const PanelGrid grid{.num_columns = set.num_columns,
                         .x_title = set.x.title,
                         .y_title = set.y.title,
                         .gap_x_in = set.num_columns > 3 ? 0.3 : 0.35};
    std::vector<Panel> panels;
    for (std::size_t i = first; i < end; ++i) {
      Panel panel{.title = panel_title(charts[i]), .before = lines_of(charts[i], most_lines)};
      if (i == first) {
        panel.before += axis_settings("x", set.x, /*is_small=*/true) +
                        axis_settings("y", set.y, /*is_small=*/true);
      }
      panel.plot = plot_of(set, charts[i], /*is_small=*/true);
      panels.push_back(std::move(panel));
    }
    figure.height_in = grid_height_in(grid, panels.size(), set.panel_in);
    figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
    figure.tables = tables_of(set, charts + first, charts + end);
    figures.push_back(std::move(figure));
  }
  return figures;
}

Figure whole_figure(const ChartSet& set, const Chart& chart) {
  Figure figure = figure_of(set);
  figure.width_in = 5.2;
  figure.height_in = 3.6;
  figure.plot = axis_settings("x", set.x, /*is_small=*/false) +
                axis_settings("y", set.y, /*is_small=*/false) + "  set xlabel " +
                gnuplot_quoted(set.x.title) + "\n  set ylabel " + gnuplot_quoted(set.y.title) +
                "\n  set key top left reverse Left samplen 2\n" +
                lines_of(chart, chart.lines.size()) + "  " +
                plot_of(set, chart, /*is_small=*/false) + "\n";
  figure.tables = tables_of(set, &chart, &chart + 1);
  return figure;
}

}  // namespace

std::vector<Figure> chart_figures(const std::vector<ChartSet>& charts) {
  std::vector<Figure> figures;
  for (const ChartSet& set : charts) {
    if (set.has_panels) {
      for (Figure& figure : panel_figures(set)) figures.push_back(std::move(figure));
    } else if (set.everybody) {
      figures.push_back(whole_figure(set, *set.everybody));
    }
  }
  return figures;
}

}  // namespace jnd::analysis
