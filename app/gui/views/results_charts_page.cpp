// The charts that the report draws as well: magnitudes with their power laws, answers with
// their curves, matches, and levels of adaptive blocks. Below them are the study's main
// results.

#include <algorithm>
#include <cmath>

#include "app/gui/views/chart_plot.h"
#include "app/gui/views/results_cards.h"
#include "app/gui/views/results_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using namespace results;

/// The report's caption: what the chart shows, and how its curves were fitted.
std::string caption_of(const analysis::ChartSet& set, const std::string& who) {
  if (who == kEveryone && set.whole) return set.whole->caption;
  return set.panels ? set.panels->caption : set.whole ? set.whole->caption : "";
}

void draw_chart(Ui& ui, const Rect& place, const analysis::ChartSet& set,
                const std::string& who) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  const analysis::Chart* const chart = set.chart_of(who);
  if (chart == nullptr) {
    return draw_notice(ui, inside, tr("{} has no answers in {}.", who, set.heading));
  }
  if (chart->value.empty() && !chart->reason.empty()) {
    return draw_without_value(ui, inside, chart_plot(set, *chart),
                              tr("No value: {}.", chart->reason));
  }
  if (!chart->caution.empty()) {
    const TextStyle amber{.font = Font::kSmall, .colour = Colour::kAmber, .wrap = true};
    const std::string words = tr("Caution: {}.", chart->caution);
    ui.text(inside.take_bottom(ui.text_height(inside.width, words, amber), 4), words, amber);
  }
  const Rect line = inside.take_bottom(value_height(ui, inside.width, *chart), 4);
  (void)draw_plot(ui, inside, chart_plot(set, *chart));
  draw_value(ui, line, chart->value, chart->detail);
  if (ui.hovered(line)) ui.tooltip(ui.mouse_x(), ui.mouse_y(), caption_of(set, who));
}

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) {
    if (!part.empty()) all += (all.empty() ? "" : " · ") + part;
  }
  return all;
}

/// A large number under its name, for the card below the charts.
struct KeyFigure {
  std::string name, value, detail;
};

const NumberLine* number_named(const ResultsModel& results, const std::string& name) {
  const auto found = std::find_if(results.numbers.begin(), results.numbers.end(),
                                  [&](const NumberLine& line) { return line.name == name; });
  return found == results.numbers.end() || found->value.empty() ? nullptr : &*found;
}

void add_number(const ResultsModel& results, const std::string& name, const std::string& title,
                std::vector<KeyFigure>& figures) {
  const NumberLine* line = number_named(results, name);
  if (line == nullptr) return;
  figures.push_back(
      {title, line->value,
       joined({line->interval,
               line->published.empty() ? "" : tr("published {}", line->published)})});
}

std::vector<KeyFigure> key_figures(const ResultsModel& results) {
  std::vector<KeyFigure> figures;
  // If the study compares blocks, its primary comparison comes first.
  if (!results.comparisons.empty() && results.comparisons.front().is_primary &&
      results.num_participants > 1) {
    const ComparisonLine& first = results.comparisons.front();
    figures.push_back(
        {first.name, first.estimate ? two_digits(*first.estimate) : tr("none"), first.detail});
  }
  add_number(results, "trial_correlation_median", tr("Correlation of repetitions"), figures);
  add_number(results, "max_speed_m_per_s", tr("Largest speed"), figures);
  add_number(results, "stroke_width_m", tr("Stroke width"), figures);
  return figures;
}

/// Draws the key figures side by side, and the chips below them.
void draw_summary(Ui& ui, const Rect& place, const ResultsModel& results,
                  ResultsViewState& state) {
  Rect inside = draw_card(ui, place,
                          results.num_participants == 1
                              ? tr("1 participant")
                              : tr("{} participants", results.num_participants));
  inside = ui.begin_scroll("summary", inside, state.summary_height);
  const float top = inside.y;
  const std::vector<KeyFigure> figures = key_figures(results);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  if (!figures.empty()) {
    const auto count = static_cast<float>(figures.size());
    const float width = (inside.width - 24 * (count - 1)) / count;
    float height = 0;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      Rect column{inside.x + static_cast<float>(i) * (width + 24), inside.y, width,
                  inside.height};
      const float name = ui.text_height(width, figures[i].name, soft);
      ui.text(column.take_top(name, 2), figures[i].name, soft);
      ui.text(column.take_top(32, 2), figures[i].value,
              {.font = Font::kAnswer, .any_length = true});
      const float detail = ui.text_height(width, figures[i].detail, soft);
      ui.text(column.take_top(detail), figures[i].detail, soft);
      height = std::max(height, name + 36 + detail);
    }
    inside.take_top(height, 14);
  }
  inside.take_top(draw_quality(ui, inside, results));
  state.summary_height = inside.y - top;
  ui.end_scroll();
}

/// The summary is as high as its contents, but leaves the figures at least their height.
float summary_height(const Rect& place, float figures, const ResultsViewState& state) {
  const float wanted = state.summary_height + 28 + 2 * kPadding;
  return std::clamp(wanted, 120.0f, std::max(120.0f, place.height - figures - kGap));
}

}  // namespace

std::string two_digits(double value) {
  return std::isfinite(value) ? table_number(value) : tr("none");
}

void draw_charts_page(Ui& ui, Rect place, const ResultsModel& results,
                      ResultsViewState& state) {
  draw_summary(ui, place.take_bottom(summary_height(place, 330, state), kGap), results, state);
  const std::string who = shown_participant(results, state);
  draw_grid(
      ui, "charts", place, results.charts, 320, 400,
      [&](const Rect& card, const analysis::ChartSet& set) { draw_chart(ui, card, set, who); });
}

}  // namespace jnd::app::gui
