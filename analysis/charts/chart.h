#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/charts/axis_range.h"
#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// Rows of one of the set's tables, and how they are drawn.
struct ChartSeries {
  enum class Look {
    kCurve,       ///< The fitted line whose value stands beside the chart.
    kOtherCurve,  ///< A fitted line of another value, dashed.
    kLaw,         ///< One of several fitted lines, in the colour `colour`.
    kBeyond,      ///< A law where nothing was measured, dotted.
    kFaintCurve,  ///< One participant's fitted line, behind the rest.
    kBand,        ///< From `low` to `high`, behind everything. Small panels do not show it.
    /// From `low` to `high` of many people's lines, in grey. It replaces the lines.
    kSpread,
    kAnswers,      ///< Points, with bars from `low` to `high`.
    kManyAnswers,  ///< Points without bars, for so many levels that each has few answers.
    kMeans,        ///< Points without bars, in the colour `colour`.
    kTrack,        ///< A line from point to point.
    kReversals,    ///< Rings on a track.
    /// Faint lines from point to point, one for each participant, behind the rest.
    kEverybodys,
    kIdentity,  ///< The line y = x. It needs no table.
  };
  Look look = Look::kCurve;
  std::size_t table = 0;  ///< The index among the tables of the set.
  /// Only rows with this number in `series_column` are drawn; without it, all are.
  std::optional<int> series;
  std::string series_column = "series";
  /// The first and last row of the series, if its rows are known to stand together. Only these
  /// are read.
  std::optional<std::pair<std::size_t, std::size_t>> rows;
  std::string x, y;  ///< Names of columns. Rows without either value are left out.
  /// Columns for the ends of bars and bands. A row without an end has none there.
  std::string low, high;
  bool has_bars_along_x = false;  ///< Whether the bars are along x.
  /// A column that makes points larger; "" for points of one size.
  std::string size;
  int colour = 1;      ///< The colour of tracks, laws and means, from 1.
  std::string legend;  ///< The legend; "" for none.
};

/// A line across the chart.
struct ChartLine {
  enum class Kind { kReference, kValue, kRate };
  Kind kind = Kind::kReference;
  double at = 0.0;
  bool is_vertical = true;
  /// The line reaches from the axis to this value of the other axis. Without it the line
  /// crosses the chart.
  std::optional<double> until;
  std::string label;  ///< For example "threshold".
};

/// The chart of one participant, or of all.
struct Chart {
  std::string who;    ///< For example "P01", or `kEverybody`.
  std::string value;  ///< For example "0.21 Pa s"; "" for none.
  /// The interval, such as "95 % 0.18 to 0.26"; why there is no value; why the value may be
  /// wrong. Each is "" if there is nothing to say.
  std::string detail, reason, caution;
  std::vector<ChartSeries> series;  ///< Drawn in this order.
  std::vector<ChartLine> lines;
};
inline constexpr char kEverybody[] = "all participants";

struct ChartAxis {
  std::string title;  ///< For example "Viscosity [Pa s]".
  std::string label;  ///< The label in the plots of the window, such as "test viscosity".
  std::string unit;   ///< For example "Pa s"; "" for none.
  bool logarithmic = false;
  /// Whether the axis runs from 0 to 1. It is labelled in percent where there is room for
  /// words.
  bool is_proportion = false;
  AxisRange range;
};

/// A figure of the report that shows everybody's chart.
struct WholeFigure {
  /// The name of its files without extension, such as "group_d_psychometric".
  std::string name;
  std::string title, caption;
  std::string thesis;  ///< The figures of the thesis to which it corresponds; "" if none.
  double width_in = 5.2, height_in = 3.6;
  /// Whether the key stands outside the axes, because no corner has room.
  bool has_key_above = false;
  /// Whether a copy with linear axes stands to the left of the logarithmic one.
  bool has_linear_beside = false;
};

/// Figures of the report with a panel for each participant.
struct PanelFigures {
  /// For example "group_d_participants". Further figures have "_2" and so on appended.
  std::string name;
  std::string title, caption, thesis;
  int num_columns = 5, most_panels = 20;
  double panel_in = 1.15;
};

/// One figure as data. The report draws it with gnuplot, and the window with its plot widget.
/// Everybody's chart and those of the participants share axes and tables. Numbers are in SI
/// units.
struct ChartSet {
  std::string section;  ///< The section of the results to which it belongs.
  std::string heading;  ///< The title of the block.
  std::optional<WholeFigure> whole;
  std::optional<PanelFigures> panels;
  ChartAxis x, y;
  std::vector<FigureTable> tables;
  std::optional<Chart> everybody;
  std::vector<Chart> participants;

  /// The chart of this participant, or of `kEverybody`; nullptr if there is none.
  [[nodiscard]] const Chart* chart_of(const std::string& who) const;
};

}  // namespace jnd::analysis
