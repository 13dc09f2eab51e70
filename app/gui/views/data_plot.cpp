#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/gui/views/data_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using analysis::FigureCell;
using analysis::FigureTable;

constexpr std::size_t kMostInColour = 6;
constexpr double kInPercent = 100.0;

/// The rows of one group in a table of the figure.
class GroupRows {
 public:
  GroupRows(const FigureTable& table, std::size_t group)
      : table_(table), series_(static_cast<double>(group + 1)) {}

  /// Calls `show` for each row with a function that returns the number in a column.
  template <typename Show>
  void each(const Show& show) const {
    const std::size_t series_at = table_.place_of("series");
    for (const std::vector<FigureCell>& row : table_.rows) {
      if (row[series_at].number != series_) continue;
      show([&](const char* column) {
        return row[table_.place_of(column)].number.value_or(NAN);
      });
    }
  }

 private:
  const FigureTable& table_;
  double series_;
};

double largest_number(const FigureTable& table, const char* column) {
  double largest = 1.0;
  const std::size_t place = table.place_of(column);
  for (const auto& row : table.rows) largest = std::max(largest, row[place].number.value_or(0));
  return largest;
}

PlotSeries answers_of(const FigureTable& table, std::size_t group, Colour colour) {
  PlotSeries points{
      .style = PlotSeries::Style::kPoints, .colour = colour, .hollow = false, .alpha = 0.9f};
  const double most = largest_number(table, "trials");
  GroupRows(table, group).each([&](const auto& number) {
    const double trials = number("trials"), share = number("proportion");
    points.x.push_back(number("intensity"));
    points.y.push_back(kInPercent * share);
    points.low.push_back(kInPercent * number("low"));
    points.high.push_back(kInPercent * number("high"));
    points.radii.push_back(2.0f + 4.5f * static_cast<float>(std::sqrt(trials / most)));
    points.names.push_back(tr("{} of {}", std::llround(share * trials), std::llround(trials)));
  });
  return points;
}

PlotSeries curve_of(const FigureTable& table, std::size_t group, Colour colour) {
  PlotSeries line{.style = PlotSeries::Style::kLine, .colour = colour, .thickness = 2.5f};
  GroupRows(table, group).each([&](const auto& number) {
    line.x.push_back(number("intensity"));
    line.y.push_back(kInPercent * number("proportion"));
  });
  return line;
}

/// The intervals of a group's thresholds; each is a bar with its ends.
std::vector<PlotSeries> thresholds_of(const FigureTable& table, std::size_t group,
                                      Colour colour) {
  // Each end of a bar extends by so many percent up and down.
  constexpr double kEnd = 1.2;
  std::vector<PlotSeries> bars;
  GroupRows(table, group).each([&](const auto& number) {
    const double low = number("low"), high = number("high");
    const double y = kInPercent * number("proportion");
    const double gap = std::numeric_limits<double>::quiet_NaN();
    bars.push_back({.style = PlotSeries::Style::kLine,
                    .colour = colour,
                    .x = {low, low, gap, low, high, gap, high, high},
                    .y = {y - kEnd, y + kEnd, gap, y, y, gap, y - kEnd, y + kEnd},
                    .thickness = 1.8f});
  });
  return bars;
}

const FigureTable* table_named(const DataResults& results, const char* name) {
  const auto found = std::ranges::find(results.tables, name, &FigureTable::name);
  return found == results.tables.end() ? nullptr : &*found;
}

}  // namespace

Colour group_colour(std::size_t group) noexcept {
  static constexpr std::array<Colour, kMostInColour> kColours = {Colour::kBlue,  Colour::kAmber,
                                                                 Colour::kGreen, Colour::kPilot,
                                                                 Colour::kRed,   Colour::kInk};
  return kColours[group % kMostInColour];
}

PlotModel data_plot(const DataResults& results, std::size_t chosen) {
  PlotModel plot{.title = tr("Psychometric functions"), .unit = results.y_title};
  if (results.groups.size() == 1) plot.title = tr("Psychometric function");
  plot.x = {.label = results.x_title, .logarithmic = results.is_logarithmic};
  plot.y = {.unit = "%", .minimum = 0.0, .maximum = kInPercent};
  for (const int percent : {0, 25, 50, 75, 100}) {
    plot.y.ticks.push_back({static_cast<double>(percent), std::to_string(percent)});
  }
  const FigureTable* answers = table_named(results, "answers");
  const FigureTable* curves = table_named(results, "curves");
  const FigureTable* thresholds = table_named(results, "thresholds");
  if (answers == nullptr || curves == nullptr || thresholds == nullptr) return plot;
  const std::size_t place = curves->place_of("intensity");
  for (const auto& row : curves->rows) {
    const double x = row[place].number.value_or(NAN);
    plot.x.minimum = std::min(plot.x.minimum.value_or(x), x);
    plot.x.maximum = std::max(plot.x.maximum.value_or(x), x);
  }
  const bool all_in_colour = results.groups.size() <= kMostInColour;
  for (std::size_t i = 0; i < results.groups.size(); ++i) {
    if (all_in_colour || i == chosen) continue;
    PlotSeries line = curve_of(*curves, i, Colour::kSoft);
    line.thickness = 1.0f;
    line.alpha = 0.4f;
    plot.series.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < results.groups.size(); ++i) {
    if (!all_in_colour && i != chosen) continue;
    const DataGroup& group = results.groups[i];
    const Colour colour = group_colour(all_in_colour ? i : 0);
    PlotSeries line = curve_of(*curves, i, colour);
    line.name = group.reason.empty() ? group.name : tr("{} (no curve)", group.name);
    plot.series.push_back(std::move(line));
    for (PlotSeries& bar : thresholds_of(*thresholds, i, colour)) {
      plot.series.push_back(std::move(bar));
    }
    plot.series.push_back(answers_of(*answers, i, colour));
  }
  if (results.chance) {
    plot.marks.push_back(
        {.at = kInPercent * *results.chance, .vertical = false, .label = tr("chance")});
  }
  return plot;
}

}  // namespace jnd::app::gui
