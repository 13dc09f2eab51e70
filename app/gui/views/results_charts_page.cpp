// The charts that the report has, too: answers with their curves, levels of adaptive blocks,
// matches.

#include "app/gui/views/chart_plot.h"
#include "app/gui/views/results_cards.h"
#include "app/gui/views/results_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

void draw_chart(Ui& ui, const Rect& place, const analysis::ChartSet& set,
                const std::string& who) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  const analysis::Chart* const chart = set.chart_of(who);
  if (chart == nullptr) {
    return draw_notice(ui, inside, tr("{} has no answers in {}.", who, set.heading));
  }
  if (chart->value.empty()) {
    return draw_without_value(ui, inside, chart_plot(set, *chart),
                              tr("No value: {}.", chart->reason));
  }
  if (!chart->caution.empty()) {
    const TextStyle amber{.font = Font::kSmall, .colour = Colour::kAmber, .wrap = true};
    const std::string words = tr("Caution: {}.", chart->caution);
    ui.text(inside.take_bottom(ui.text_height(inside.width, words, amber), 4), words, amber);
  }
  const Rect line = inside.take_bottom(30, 4);
  (void)draw_plot(ui, inside, chart_plot(set, *chart));
  draw_value(ui, line, chart->value, chart->detail);
}

}  // namespace

void draw_charts_page(Ui& ui, const Rect& place, const ResultsModel& results,
                      ResultsViewState& state) {
  const std::string who = shown_participant(results, state);
  draw_grid(
      ui, "charts", place, results.charts, 340, 270,
      [&](const Rect& card, const analysis::ChartSet& set) { draw_chart(ui, card, set, who); });
}

}  // namespace jnd::app::gui
