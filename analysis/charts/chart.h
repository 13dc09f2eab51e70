#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/charts/axis_range.h"
#include "analysis/charts/figure_table.h"

namespace jnd::analysis {

/// Rows of one of the set's tables, and how they look.
struct ChartSeries {
  enum class Look {
    kCurve,        ///< A fitted line.
    kAnswers,      ///< Points, `low` to `high` as bars.
    kManyAnswers,  ///< Points of so many levels that each has few answers; no bars.
    kTrack,        ///< A line from point to point.
    kReversals,    ///< Rings on a track.
    kEverybodys,   ///< Faint lines, one a participant, behind the rest.
    kIdentity,     ///< y = x; has no table.
  };
  Look look = Look::kCurve;
  std::size_t table = 0;  ///< In the tables of the set.
  int series = 0;         ///< The rows with this number in the column "series"; 0: all rows.
  std::string x, y;       ///< Names of columns; rows without either are left out.
  std::string low, high;  ///< Of the bars; a row without an end has none there.
  std::string size;       ///< A column that makes points larger; "" for points alike.
  int colour = 1;         ///< Of tracks, from 1.
  std::string legend;     ///< "" for none.
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

/// One figure as data: what the report draws with gnuplot, the window with its plot widget.
/// Everybody's chart and those of the participants share axes and tables. Numbers in SI units.
struct ChartSet {
  std::string name;     ///< Of files, without ending: "felt_participants".
  std::string section;  ///< Of the results it belongs to.
  std::string title, caption;
  std::string heading;  ///< Above a single chart, where the title is too long: the block's.
  std::string thesis;   ///< The figures of the thesis that it answers; "" if none.
  ChartAxis x, y;
  std::vector<FigureTable> tables;
  std::optional<Chart> everybody;
  std::vector<Chart> participants;
  /// The report has a panel for each participant, so many in a row; else everybody's chart.
  bool has_panels = true;
  int num_columns = 5, most_panels = 20;
  double panel_in = 1.15;

  /// Of this participant, or `kEverybody`; nullptr for one without.
  [[nodiscard]] const Chart* chart_of(const std::string& who) const;
};

}  // namespace jnd::analysis
