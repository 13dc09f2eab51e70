#include "app/gui/views/chart_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using analysis::ChartSeries;
using analysis::FigureTable;
using Look = ChartSeries::Look;

constexpr double kPercent = 100.0;

Colour track_colour(int number) {
  constexpr Colour kColours[] = {Colour::kBlue, Colour::kAmber, Colour::kGreen, Colour::kRed,
                                 Colour::kInk};
  return kColours[static_cast<std::size_t>(number - 1) % std::size(kColours)];
}

PlotSeries look_of(const ChartSeries& series) {
  using Style = PlotSeries::Style;
  switch (series.look) {
    case Look::kCurve:
      return {.style = Style::kLine, .thickness = 2.5f};
    case Look::kOtherCurve:
      return {
          .style = Style::kLine, .colour = Colour::kAmber, .dashed = true, .thickness = 1.5f};
    case Look::kLaw:
      return {.style = Style::kLine, .colour = track_colour(series.colour), .thickness = 2.5f};
    case Look::kBeyond:
      return {.style = Style::kLine,
              .colour = track_colour(series.colour),
              .dashed = true,
              .thickness = 1.0f};
    case Look::kFaintCurve:
      return {.style = Style::kLine, .colour = Colour::kSoft, .thickness = 1.0f, .alpha = 0.4f};
    case Look::kBand:
      return {.style = Style::kBand};
    case Look::kSpread:
      return {.style = Style::kBand, .colour = Colour::kSoft};
    case Look::kMeans:
      return {.style = Style::kPoints, .colour = track_colour(series.colour), .hollow = false};
    case Look::kAnswers:
    case Look::kManyAnswers:
      return {.style = Style::kPoints, .colour = Colour::kInk};
    case Look::kTrack:
      return {.style = Style::kLine, .colour = track_colour(series.colour), .thickness = 1.5f};
    case Look::kReversals:
      return {.style = Style::kPoints, .colour = track_colour(series.colour)};
    case Look::kEverybodys:
      return {.style = Style::kLine, .colour = Colour::kSoft, .thickness = 1.0f, .alpha = 0.6f};
    case Look::kIdentity:
      return {
          .style = Style::kLine, .colour = Colour::kSoft, .dashed = true, .thickness = 1.5f};
  }
  return {};
}

/// The rows of a table that a series shows.
class SeriesRows {
 public:
  SeriesRows(const FigureTable& table, const ChartSeries& series)
      : table_(table), series_(series), series_at_(table.place_of(series.series_column)) {}

  /// Calls `show` with each row that has an x and a y.
  template <typename Show>
  void each(const Show& show) const {
    for (const auto& row : table_.rows) {
      if (series_.series && row[series_at_].number != *series_.series) continue;
      if (number(row, series_.x) && number(row, series_.y)) show(row);
    }
  }
  [[nodiscard]] std::optional<double> number(const std::vector<analysis::FigureCell>& row,
                                             const std::string& column) const {
    const std::size_t place = table_.place_of(column);
    return place < row.size() ? row[place].number : std::nullopt;
  }

 private:
  const FigureTable& table_;
  const ChartSeries& series_;
  std::size_t series_at_;
};

/// The counts of a row, as "7 of 10"; "" if it has none.
std::string counts_of(const SeriesRows& rows, const std::vector<analysis::FigureCell>& row) {
  const auto num_yes = rows.number(row, "num_yes");
  const auto num_trials = rows.number(row, "num_trials");
  if (!num_yes || !num_trials) return "";
  return tr("{} of {}", std::llround(*num_yes), std::llround(*num_trials));
}

PlotSeries series_of(const FigureTable& table, const ChartSeries& series, double y_unit) {
  PlotSeries plotted = look_of(series);
  plotted.name = series.legend;
  const SeriesRows rows(table, series);
  const bool has_bars =
      series.look == Look::kAnswers && !series.low.empty() && !series.has_bars_along_x;
  double largest = 0.0;
  rows.each([&](const auto& row) {
    largest = std::max(largest, rows.number(row, series.size).value_or(0.0));
  });
  rows.each([&](const auto& row) {
    const double y = y_unit * *rows.number(row, series.y);
    plotted.x.push_back(*rows.number(row, series.x));
    plotted.y.push_back(y);
    const std::string counts = counts_of(rows, row);
    if (!counts.empty()) plotted.names.push_back(counts);
    if (has_bars) {
      const auto end = [&](const std::string& column) {
        const auto found = rows.number(row, column);
        return found ? y_unit * *found : y;
      };
      plotted.low.push_back(end(series.low));
      plotted.high.push_back(end(series.high));
    }
    if (series.look == Look::kManyAnswers && largest > 0.0) {
      const double share = rows.number(row, series.size).value_or(0.0) / largest;
      plotted.radii.push_back(1.5f + 5.0f * static_cast<float>(std::sqrt(share)));
    }
  });
  return plotted;
}

PlotSeries band_of(const FigureTable& table, const ChartSeries& series, double y_unit) {
  PlotSeries plotted = look_of(series);
  plotted.name = series.legend;
  const SeriesRows rows(table, series);
  rows.each([&](const auto& row) {
    const auto low = rows.number(row, series.low), high = rows.number(row, series.high);
    if (!low || !high) return;
    plotted.x.push_back(*rows.number(row, series.x));
    plotted.low.push_back(y_unit * *low);
    plotted.high.push_back(y_unit * *high);
  });
  return plotted;
}

/// Error bars along x: one line for each row, with gaps between them.
PlotSeries bars_along_x(const FigureTable& table, const ChartSeries& series, double y_unit) {
  PlotSeries plotted = look_of(series);
  plotted.style = PlotSeries::Style::kLine;
  plotted.thickness = 1.5f;
  const double gap = std::numeric_limits<double>::quiet_NaN();
  const SeriesRows rows(table, series);
  rows.each([&](const auto& row) {
    const auto low = rows.number(row, series.low), high = rows.number(row, series.high);
    if (!low || !high) return;
    const double y = y_unit * *rows.number(row, series.y);
    plotted.x.insert(plotted.x.end(), {*low, *high, gap});
    plotted.y.insert(plotted.y.end(), {y, y, gap});
  });
  return plotted;
}

PlotSeries identity_of(const analysis::ChartSet& set, const ChartSeries& series) {
  PlotSeries plotted = look_of(series);
  plotted.name = series.legend;
  const double low = std::max(set.x.range.low, set.y.range.low);
  const double high = std::min(set.x.range.high, set.y.range.high);
  if (low < high) {
    plotted.x = {low, high};
    plotted.y = {low, high};
  }
  return plotted;
}

PlotSeries drawn(const analysis::ChartSet& set, const ChartSeries& series, double y_unit) {
  if (series.look == Look::kIdentity) return identity_of(set, series);
  const FigureTable& table = set.tables[series.table];
  if (series.look == Look::kBand || series.look == Look::kSpread) {
    return band_of(table, series, y_unit);
  }
  return series_of(table, series, y_unit);
}

PlotMark mark_of(const analysis::ChartLine& line, double unit, double until_unit) {
  const bool is_value = line.kind == analysis::ChartLine::Kind::kValue;
  PlotMark mark{.at = unit * line.at,
                .vertical = line.is_vertical,
                .label = line.label,
                .colour = !is_value          ? Colour::kSoft
                          : line.is_vertical ? Colour::kAmber
                                             : Colour::kInk,
                .dashed = !is_value};
  if (line.until) mark.until = until_unit * *line.until;
  return mark;
}

PlotAxis axis_of(const analysis::ChartAxis& axis) {
  PlotAxis plotted{.logarithmic = axis.logarithmic};
  if (axis.is_proportion) {
    plotted.minimum = 0.0;
    plotted.maximum = kPercent;
    for (const int percent : {0, 25, 50, 75, 100}) {
      plotted.ticks.push_back({static_cast<double>(percent), std::to_string(percent)});
    }
    return plotted;
  }
  plotted.label = axis.label;
  plotted.unit = axis.unit;
  // A logarithmic axis ends where the report's axis does, and an axis that begins at 0 begins
  // there. Other linear axes end at ticks.
  if (axis.logarithmic || axis.range.low == 0.0) plotted.minimum = axis.range.low;
  if (axis.logarithmic) plotted.maximum = axis.range.high;
  return plotted;
}

}  // namespace

PlotModel chart_plot(const analysis::ChartSet& set, const analysis::Chart& chart) {
  PlotModel plot{.title = set.heading};
  plot.x = axis_of(set.x);
  plot.y = axis_of(set.y);
  // The widget shows beside the heading what the y axis is about.
  plot.unit = set.y.is_proportion || set.y.label.find(':') != std::string::npos ? set.y.label
                                                                                : set.y.unit;
  plot.y.label.clear();
  const double x_unit = set.x.is_proportion ? kPercent : 1.0;
  const double y_unit = set.y.is_proportion ? kPercent : 1.0;
  for (const ChartSeries& series : chart.series) {
    if (series.has_bars_along_x) {
      plot.series.push_back(bars_along_x(set.tables[series.table], series, y_unit));
    }
    PlotSeries plotted = drawn(set, series, y_unit);
    // Faint curves are named last, so that the legend begins with what the chart is about.
    if (series.look == Look::kFaintCurve) plotted.name.clear();
    if (!plotted.x.empty()) plot.series.push_back(std::move(plotted));
  }
  for (const ChartSeries& series : chart.series) {
    if (series.look != Look::kFaintCurve || series.legend.empty()) continue;
    plot.series.push_back(look_of(series));
    plot.series.back().name = series.legend;
  }
  for (const analysis::ChartLine& line : chart.lines) {
    plot.marks.push_back(line.is_vertical ? mark_of(line, x_unit, y_unit)
                                          : mark_of(line, y_unit, x_unit));
  }
  return plot;
}

PlotModel box_plot(const results::BoxFigure& figure) {
  PlotModel plot{.title = figure.title, .unit = figure.unit};
  plot.y.unit = figure.unit;
  for (std::size_t i = 0; i < figure.boxes.size(); ++i) {
    const results::Box& box = figure.boxes[i];
    const auto x = static_cast<double>(i + 1);
    plot.x.ticks.push_back({x, box.label});
    PlotBox drawn{.x = x,
                  .lower_whisker = box.plot.lower_whisker,
                  .lower_quartile = box.plot.lower_quartile,
                  .median = box.plot.median,
                  .upper_quartile = box.plot.upper_quartile,
                  .upper_whisker = box.plot.upper_whisker,
                  .name = box.label};
    for (const results::Box::Outlier& outlier : box.outliers) {
      drawn.outliers.push_back({outlier.value, outlier.participant});
    }
    plot.boxes.push_back(std::move(drawn));
  }
  return plot;
}

}  // namespace jnd::app::gui
