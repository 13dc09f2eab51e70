// Yes-no and same-different answers with their curves, and the levels of adaptive blocks.

#include <algorithm>

#include "app/gui/views/results_cards.h"
#include "app/gui/views/results_parts.h"
#include "app/gui/views/results_plots.h"

namespace jnd::app::gui {
namespace {

using namespace results;

void draw_threshold(Ui& ui, const Rect& place, const Threshold& block, const std::string& who) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  const ThresholdFigure* const figure = figure_of(block, who);
  if (figure == nullptr) {
    return draw_notice(ui, inside, who + " has no answers in " + block.title + ".");
  }
  if (figure->value.empty()) {
    return draw_without_value(ui, inside, threshold_plot(block, *figure),
                              "No value: " + figure->reason + ".");
  }
  if (!figure->caution.empty()) {
    const TextStyle amber{.font = Font::kSmall, .colour = Colour::kAmber, .wrap = true};
    const std::string words = "Caution: " + figure->caution + ".";
    ui.text(inside.take_bottom(ui.text_height(inside.width, words, amber), 4), words, amber);
  }
  const Rect line = inside.take_bottom(30, 4);
  (void)draw_plot(ui, inside, threshold_plot(block, *figure));
  draw_value(ui, line, figure->value, figure->detail);
}

void add_points(PlotModel& plot, const std::vector<Point>& points, PlotSeries look,
                double y_unit) {
  if (points.empty()) return;
  for (const Point& point : points) {
    look.x.push_back(point.x);
    look.y.push_back(y_unit * point.y);
  }
  plot.series.push_back(std::move(look));
}

PlotModel answers_plot(const Threshold& block, const ThresholdFigure& figure) {
  PlotModel plot{.title = block.title, .unit = block.answer + " in percent"};
  plot.x = {.label = "test " + block.quantity, .unit = block.unit, .logarithmic = true};
  plot.y = {.minimum = 0.0, .maximum = kPercent};
  for (const int percent : {0, 25, 50, 75, 100}) {
    plot.y.ticks.push_back({static_cast<double>(percent), std::to_string(percent)});
  }
  plot.legend = false;
  add_points(plot, figure.curve, {.style = PlotSeries::Style::kLine, .thickness = 2.5f},
             kPercent);
  plot.series.push_back(answer_points(figure.points, block.has_fixed_levels));
  if (block.reference) plot.marks.push_back({.at = *block.reference});
  if (figure.line) {
    plot.marks.push_back({.at = *figure.line,
                          .label = "threshold",
                          .colour = Colour::kAmber,
                          .dashed = false,
                          .until = 0.5 * kPercent});
  }
  return plot;
}

PlotModel tracks_plot(const Threshold& block, const ThresholdFigure& figure) {
  PlotModel plot{.title = block.title, .unit = block.unit};
  plot.x = {.label = "trial"};
  plot.y = {.unit = block.unit, .logarithmic = block.is_logarithmic};
  plot.legend = false;
  constexpr Colour kColours[] = {Colour::kBlue, Colour::kAmber, Colour::kGreen};
  std::size_t number = 0;
  for (const Track& track : figure.tracks) {
    const Colour colour = kColours[number++ % std::size(kColours)];
    add_points(plot, track.levels,
               {.style = PlotSeries::Style::kLine, .colour = colour, .thickness = 1.5f}, 1.0);
    add_points(plot, track.reversals, {.style = PlotSeries::Style::kPoints, .colour = colour},
               1.0);
  }
  if (block.reference) plot.marks.push_back({.at = *block.reference, .vertical = false});
  if (figure.line) {
    plot.marks.push_back({.at = *figure.line,
                          .vertical = false,
                          .label = "threshold",
                          .colour = Colour::kInk,
                          .dashed = false});
  }
  return plot;
}

}  // namespace

PlotModel threshold_plot(const Threshold& block, const ThresholdFigure& figure) {
  return block.has_tracks ? tracks_plot(block, figure) : answers_plot(block, figure);
}

void draw_thresholds_page(Ui& ui, const Rect& place, const ResultsModel& results,
                          ResultsViewState& state) {
  const std::string who = shown_participant(results, state);
  draw_grid(
      ui, "thresholds", place, results.thresholds, 340, 270,
      [&](const Rect& card, const Threshold& block) { draw_threshold(ui, card, block, who); });
}

}  // namespace jnd::app::gui
