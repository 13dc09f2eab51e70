#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/charts/axis_range.h"
#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// Rows of one of the set's tables, and how they look.
struct ChartSeries {
  enum class Look {
    kCurve,        ///< The fitted line whose value stands beside the chart.
    kOtherCurve,   ///< A fitted line of another value, dashed.
    kLaw,          ///< One of several fitted lines, in the colour of `colour`.
    kBeyond,       ///< A law where nothing was measured, dotted.
    kFaintCurve,   ///< Somebody's fitted line behind the rest.
    kBand,         ///< From `low` to `high`, behind everything; not in small panels.
    kSpread,       ///< From `low` to `high` of many people's lines, grey, instead of them.
    kAnswers,      ///< Points, `low` to `high` as bars.
    kManyAnswers,  ///< Points of so many levels that each has few answers; no bars.
    kMeans,        ///< Points in the colour of `colour`, without bars.
    kTrack,        ///< A line from point to point.
    kReversals,    ///< Rings on a track.
    kEverybodys,   ///< Faint lines from point to point, one a participant, behind the rest.
    kIdentity,     ///< y = x; has no table.
  };
  Look look = Look::kCurve;
  std::size_t table = 0;      ///< In the tables of the set.
  std::optional<int> series;  ///< The rows with this number in `series_column`; else all.
  std::string series_column = "series";
  /// Its first and last row, where it is known that they stand together: others are not read.
  std::optional<std::pair<std::size_t, std::size_t>> rows;
  std::string x, y;               ///< Names of columns; rows without either are left out.
  std::string low, high;          ///< Of bars and band; a row without an end has none there.
  bool has_bars_along_x = false;  ///< The bars are of x.
  std::string size;               ///< A column that makes points larger; "" for points alike.
  int colour = 1;                 ///< Of tracks, laws and means, from 1.
  std::string legend;             ///< "" for none.
};

/// A line across the chart.
struct ChartLine {
  enum class Kind { kReference, kValue, kRate };
  Kind kind = Kind::kReference;
  double at = 0.0;
  bool is_vertical = true;
  std::optional<double> until;  ///< From the axis to this value of the other one; else across.
  std::string label;            ///< "threshold"
};

/// One participant's chart, or everybody's.
struct Chart {
  std::string who;    ///< "P01"; `kEverybody`.
  std::string value;  ///< "0.21 Pa s"; "" for none.
  /// "95 % 0.18 to 0.26"; why there is no value; why it may be wrong. "" for nothing.
  std::string detail, reason, caution;
  std::vector<ChartSeries> series;  ///< Drawn in this order.
  std::vector<ChartLine> lines;
};
inline constexpr char kEverybody[] = "all participants";

struct ChartAxis {
  std::string title;  ///< "Viscosity [Pa s]"
  std::string label;  ///< Beside a plot of its own: "test viscosity".
  std::string unit;   ///< "Pa s"; "" for none.
  bool logarithmic = false;
  bool is_proportion = false;  ///< From 0 to 1, told in percent where there is room for words.
  AxisRange range;
};

/// A figure of the report, made of everybody's chart.
struct WholeFigure {
  std::string name;  ///< Of its files, without ending: "group_d_psychometric".
  std::string title, caption;
  std::string thesis;  ///< The figures of the thesis that it answers; "" if none.
  double width_in = 5.2, height_in = 3.6;
  bool has_key_above = false;      ///< Outside the axes, where a corner has no room.
  bool has_linear_beside = false;  ///< Logarithmic axes; the same on linear ones to the left.
};

/// Figures of the report, made of a panel for each participant.
struct PanelFigures {
  std::string name;  ///< "group_d_participants"; a second figure has "_2" behind it.
  std::string title, caption, thesis;
  int num_columns = 5, most_panels = 20;
  double panel_in = 1.15;
};

/// One figure as data: what the report draws with gnuplot, the window with its plot widget.
/// Everybody's chart and those of the participants share axes and tables. Numbers in SI units.
struct ChartSet {
  std::string section;  ///< Of the results it belongs to.
  std::string heading;  ///< The block's title.
  std::optional<WholeFigure> whole;
  std::optional<PanelFigures> panels;
  ChartAxis x, y;
  std::vector<FigureTable> tables;
  std::optional<Chart> everybody;
  std::vector<Chart> participants;

  /// Of this participant, or `kEverybody`; nullptr for one without.
  [[nodiscard]] const Chart* chart_of(const std::string& who) const;
};

}  // namespace jnd::analysis
