#include "analysis/report/value_figure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "analysis/charts/axis_range.h"
#include "analysis/report/plot_parts.h"
#include "analysis/statistics/summary.h"
#include "analysis/words/said.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostValuePanels = 48;
/// With more pairs, a line for each would hide the others.
constexpr std::size_t kMostJoinedPairs = 200;

std::vector<ComparedValues> shown_of(const std::vector<ComparedValues>& groups) {
  std::vector<ComparedValues> shown;
  for (const ComparedValues& group : groups) {
    const bool has_values = std::ranges::any_of(
        group.values, [](const std::vector<double>& values) { return !values.empty(); });
    if (has_values && shown.size() < kMostValuePanels) shown.push_back(group);
  }
  if (shown.empty()) throw core::Error("expected values to draw, found none");
  return shown;
}

/// Steps to the side, -1 to 1, for values that would overlap. Values at one place move left and
/// right in turn, so the same data always look the same.
std::vector<double> steps_aside(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  const auto [least, most] = std::ranges::minmax(values);
  const double near = 0.02 * (most - least);
  std::vector<double> steps(values.size(), 0.0);
  std::size_t num_near = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    num_near = values[order[i]] - values[order[i - 1]] <= near ? num_near + 1 : 0;
    const std::size_t pair = (num_near + 1) / 2;
    const double step = std::min(1.0, 0.2 * static_cast<double>(pair));
    steps[order[i]] = num_near % 2 == 1 ? step : -step;
  }
  return steps;
}

FigureTable values_table(const std::vector<ComparedValues>& groups) {
  FigureTable table{.name = "values",
                    .columns = {"series", "group", "condition", "place", "pair", "value"}};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const ComparedValues& group = groups[i];
    for (std::size_t condition = 0; condition < group.values.size(); ++condition) {
      const std::vector<double>& values = group.values[condition];
      const std::vector<double> aside =
          group.are_paired ? std::vector<double>(values.size(), 0.0) : steps_aside(values);
      for (std::size_t k = 0; k < values.size(); ++k) {
        table.rows.push_back({static_cast<int>(i) + 1, group.name, group.conditions[condition],
                              static_cast<double>(condition) + 1.0 + 0.25 * aside[k],
                              static_cast<int>(k) + 1, values[k]});
      }
    }
  }
  return table;
}

FigureTable means_table(const std::vector<ComparedValues>& groups) {
  FigureTable table{.name = "means",
                    .columns = {"series", "group", "condition", "place", "mean", "low", "high",
                                "num_values"}};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const ComparedValues& group = groups[i];
    for (std::size_t condition = 0; condition < group.values.size(); ++condition) {
      const Summary summary = summary_of(group.values[condition]);
      if (!summary.mean) continue;
      table.rows.push_back({static_cast<int>(i) + 1, group.name, group.conditions[condition],
                            static_cast<double>(condition) + (group.are_paired ? 1.12 : 1.0),
                            *summary.mean, summary.mean_ci95.low.value_or(*summary.mean),
                            summary.mean_ci95.high.value_or(*summary.mean),
                            summary.num_values});
    }
  }
  return table;
}

/// A table with one row for each step of a person from one condition to the next.
FigureTable pairs_table(const std::vector<ComparedValues>& groups) {
  FigureTable table{.name = "pairs", .columns = {"series", "pair", "place", "value", "next"}};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const ComparedValues& group = groups[i];
    if (!group.are_paired) continue;
    const std::size_t num_pairs = std::min(group.values.front().size(), kMostJoinedPairs);
    for (std::size_t k = 0; k < num_pairs; ++k) {
      for (std::size_t condition = 0; condition + 1 < group.values.size(); ++condition) {
        table.rows.push_back({static_cast<int>(i) + 1, static_cast<int>(k) + 1,
                              static_cast<double>(condition) + 1.0, group.values[condition][k],
                              group.values[condition + 1][k] - group.values[condition][k]});
      }
    }
  }
  return table;
}

std::vector<double> all_values(const std::vector<ComparedValues>& groups, std::size_t first = 0,
                               std::size_t last = std::numeric_limits<std::size_t>::max()) {
  std::vector<double> all;
  for (const ComparedValues& group : groups) {
    for (std::size_t i = first; i < std::min(last, group.values.size()); ++i) {
      all.insert(all.end(), group.values[i].begin(), group.values[i].end());
    }
  }
  return all;
}

constexpr double kPanelsWidthIn = 6.6, kPlotWidthIn = 4.6;
constexpr int kNumPanelColumns = 4;

/// How the names of conditions stand below a plot: each on its line if there is room, else
/// aslant and cut where they are very long.
class NamesBelow {
 public:
  NamesBelow(std::vector<std::string> names, bool small) : names_(std::move(names)) {
    const PanelGrid grid;
    const double width_in =
        small
            ? (kPanelsWidthIn - grid.left_in - grid.right_in) / kNumPanelColumns - grid.gap_x_in
            : kPlotWidthIn - 1.0;
    const double letter_in = small ? kSmallLetterIn : 1.3 * kSmallLetterIn;
    const std::size_t most_letters = small ? 16 : 24;
    std::size_t longest = 0;
    for (std::string& name : names_) {
      name = shortened(name, most_letters);
      longest = std::max(longest, num_letters_of(name));
    }
    const double longest_in = static_cast<double>(longest) * letter_in;
    are_aslant_ = longest_in > width_in / static_cast<double>(names_.size());
    if (are_aslant_) extra_in_ = std::max(0.0, 0.6 * longest_in - 0.1);
  }

  [[nodiscard]] std::string tics() const {
    std::string tics = named_tics("x", names_, /*upright=*/false);
    if (are_aslant_) tics.insert(tics.size() - 1, " rotate by 35 right");
    return tics;
  }
  /// Room that the names need beyond that of one line.
  [[nodiscard]] double extra_in() const noexcept { return extra_in_; }

 private:
  std::vector<std::string> names_;
  bool are_aslant_ = false;
  double extra_in_ = 0.0;
};

/// One plot, or a panel for each group. `below_in`: what is written below a plot needs so much
/// more room than one line.
void lay_out(Figure& figure, const std::vector<ComparedValues>& groups,
             const std::string& x_title, const std::string& y_title, double below_in,
             const std::function<std::string(bool small)>& axes,
             const std::function<std::string(int series)>& plot) {
  if (groups.size() == 1) {
    figure.width_in = kPlotWidthIn;
    figure.height_in = 3.6 + below_in;
    figure.plot = (x_title.empty() ? "" : "  set xlabel " + gnuplot_quoted(x_title) + "\n") +
                  "  set ylabel " + gnuplot_quoted(y_title) + "\n" + axes(/*small=*/false) +
                  "  plot " + plot(1) + "\n";
    return;
  }
  PanelGrid grid{.num_columns = kNumPanelColumns, .x_title = x_title, .y_title = y_title};
  grid.bottom_in += below_in;
  grid.gap_y_in += below_in;
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    panels.push_back({.title = groups[i].name,
                      .before = axes(/*small=*/true),
                      .plot = "plot " + plot(static_cast<int>(i) + 1)});
  }
  figure.width_in = kPanelsWidthIn;
  figure.height_in = grid_height_in(grid, panels.size(), 1.2);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
}

}  // namespace

Figure value_figure(const std::vector<ComparedValues>& groups, const std::string& value_name) {
  const std::vector<ComparedValues> shown = shown_of(groups);
  Figure figure{
      .name = "comparison",
      .section = "comparison",
      .title = said("Values by condition"),
      .caption = said("Each value, and the mean of each condition with its 95 % interval.")};
  figure.tables = {values_table(shown), means_table(shown), pairs_table(shown)};
  std::vector<double> drawn = all_values(shown);
  for (const std::vector<FigureCell>& row : figure.tables[1].rows) {
    for (const char* end : {"low", "high"}) {
      drawn.push_back(*row[figure.tables[1].place_of(end)].number);
    }
  }
  const AxisRange y = axis_range(drawn);
  const std::vector<std::string>& conditions = shown.front().conditions;
  const auto axes = [&](bool small) {
    std::string tics = NamesBelow(conditions, small).tics();
    if (small) tics.insert(tics.size() - 1, " font small");
    return "  set xrange [0.5:" + plot_number(static_cast<double>(conditions.size()) + 0.5) +
           "]\n" + tics + "  set yrange " + range_words(y) + "\n" +
           (small ? small_tics("y", y) : "") + "  set bars 0\n";
  };
  const auto plot = [&](int series) {
    const ComparedValues& group = shown[static_cast<std::size_t>(series) - 1];
    std::string commands;
    if (group.are_paired) {
      commands = from_table(figure.tables[2]) + "'place':" + if_series(series, "value") +
                 ":(1):'next' with vectors nohead lc rgb '#BBBBBB' lw 1 dt 1, ";
    }
    return commands + from_table(figure.tables[0]) + "'place':" + if_series(series, "value") +
           " with points lc rgb '#777777' pt 6 ps 0.6, " + from_table(figure.tables[1]) +
           "'place':" + if_series(series, "mean") +
           ":'low':'high' with yerrorbars lt 1 lw 2 pt 7 ps 0.8";
  };
  const double below_in = NamesBelow(conditions, shown.size() > 1).extra_in();
  lay_out(figure, shown, "", value_name, below_in, axes, plot);
  return figure;
}

Figure scatter_figure(const std::vector<ComparedValues>& groups, bool has_line) {
  const std::vector<ComparedValues> shown = shown_of(groups);
  Figure figure{.name = "comparison",
                .section = "comparison",
                .title = said("Pairs of values"),
                .caption = said("Each pair of values{}",
                                (has_line ? said(", and the line of least squares.") : "."))};
  FigureTable pairs{.name = "pairs", .columns = {"series", "group", "first", "second"}};
  FigureTable lines{.name = "lines", .columns = {"series", "first", "second"}};
  const AxisRange x = axis_range(all_values(shown, 0, 1)), y = axis_range(all_values(shown, 1));
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::vector<double>&a = shown[i].values[0], &b = shown[i].values[1];
    const int series = static_cast<int>(i) + 1;
    double mean_a = 0.0, mean_b = 0.0, products = 0.0, squares = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      pairs.rows.push_back({series, shown[i].name, a[k], b[k]});
      mean_a += a[k] / static_cast<double>(a.size());
      mean_b += b[k] / static_cast<double>(a.size());
    }
    for (std::size_t k = 0; k < a.size(); ++k) {
      products += (a[k] - mean_a) * (b[k] - mean_b);
      squares += (a[k] - mean_a) * (a[k] - mean_a);
    }
    if (!has_line || !(squares > 0.0)) continue;
    const auto [least, most] = std::ranges::minmax(a);
    for (const double at : {least, most}) {
      lines.rows.push_back({series, at, mean_b + products / squares * (at - mean_a)});
    }
  }
  const bool draws_lines = !lines.rows.empty();
  figure.tables.push_back(std::move(pairs));
  if (draws_lines) figure.tables.push_back(std::move(lines));
  const auto axes = [&](bool small) {
    return "  set xrange " + range_words(x) + "\n  set yrange " + range_words(y) + "\n" +
           (small ? small_tics("x", x) + small_tics("y", y) : "");
  };
  const auto plot = [&](int series) {
    return from_table(figure.tables[0]) + "'first':" + if_series(series, "second") +
           " with points lt 1 pt 6 ps 0.7" +
           (draws_lines ? ", " + from_table(figure.tables[1]) + "'first':" +
                              if_series(series, "second") + " with lines lt 1 lw 1.5"
                        : "");
  };
  lay_out(figure, shown, shown.front().conditions[0], shown.front().conditions[1], 0.0, axes,
          plot);
  return figure;
}

}  // namespace jnd::analysis
