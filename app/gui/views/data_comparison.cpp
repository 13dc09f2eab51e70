// Shows which parameters differ between the groups, and how far apart their thresholds are.

#include <algorithm>

#include "app/gui/views/data_parts.h"
#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kContrastRow = 46, kModelRow = 30;

void draw_contrasts(Ui& ui, Rect& place, const DataComparison& comparison) {
  std::vector<ColumnLook> columns = {{"", 2.6f},
                                     {tr("threshold"), 0.7f, Align::kRight},
                                     {tr("difference"), 1.3f, Align::kRight},
                                     {tr("ratio"), 1.3f, Align::kRight},
                                     {tr("p"), 0.8f, Align::kRight},
                                     {tr("p (Holm)"), 0.8f, Align::kRight}};
  need_room_for_titles(ui, columns);
  for (const DataContrast& one : comparison.contrasts) {
    need_room(ui, columns[4], one.p_value, Font::kMono);
    need_room(ui, columns[5], one.p_value_holm, Font::kMono);
  }
  draw_table_head(ui, place, columns);
  for (const DataContrast& one : comparison.contrasts) {
    const Rect row = place.take_top(kContrastRow);
    const std::vector<Rect> cells = cells_of(row, columns);
    const TextStyle mono{.font = Font::kMono, .align = Align::kRight, .any_length = true};
    const std::string pair_words = tr("{} less {}", one.other, one.one);
    ui.text(cells[0], pair_words, {.font = Font::kSmall, .any_length = true});
    if (ui.hovered(row)) ui.tooltip(ui.mouse_x(), ui.mouse_y(), pair_words);
    ui.text(cells[1], one.at, mono);
    const auto pair = [&](Rect cell, const DataValue& value) {
      if (value.interval.empty()) return (void)ui.text(cell, value.value, mono);
      cell.take_top(3);
      ui.text(cell.take_top(21), value.value, mono);
      ui.text(cell.take_top(16), value.interval.substr(0, value.interval.find(" (")),
              {.font = Font::kTiny,
               .colour = Colour::kSoft,
               .align = Align::kRight,
               .any_length = true});
    };
    pair(cells[2], one.difference);
    pair(cells[3], one.ratio);
    ui.text(cells[4], one.p_value, mono);
    ui.text(cells[5], one.p_value_holm,
            {.font = Font::kMono,
             .colour = one.differs ? Colour::kBlue : Colour::kInk,
             .align = Align::kRight,
             .any_length = true});
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
}

void draw_models(Ui& ui, Rect& place, const DataComparison& comparison) {
  std::vector<ColumnLook> columns = {{tr("model"), 3.0f},
                                     {tr("parameters"), 1.0f, Align::kRight},
                                     {tr("log-likelihood"), 1.1f, Align::kRight},
                                     {"AIC", 1.0f, Align::kRight},
                                     {"BIC", 1.0f, Align::kRight}};
  need_room_for_titles(ui, columns);
  draw_table_head(ui, place, columns);
  for (const DataModel& one : comparison.models) {
    const Rect row = place.take_top(kModelRow);
    const std::vector<Rect> cells = cells_of(row, columns);
    const TextStyle mono{.font = Font::kMono, .align = Align::kRight, .any_length = true};
    ui.text(cells[0], one.name, {.font = Font::kSmall, .any_length = true});
    ui.text(cells[1], std::to_string(one.num_parameters), mono);
    ui.text(cells[2], one.log_likelihood, mono);
    // A word marks the least value, not the colour alone.
    const auto criterion = [&](const Rect& cell, const std::string& value, bool is_least) {
      ui.text(cell, is_least ? tr("least {}", value) : value,
              {.font = Font::kMono,
               .colour = is_least ? Colour::kBlue : Colour::kInk,
               .align = Align::kRight,
               .any_length = true});
    };
    criterion(cells[3], one.aic, one.has_least_aic);
    criterion(cells[4], one.bic, one.has_least_bic);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
}

/// Offers to compare many groups, which happens only if somebody asks for it.
void draw_offer(Ui& ui, const Rect& place, const DataView& data, DataViewResult& result) {
  const std::size_t groups = data.results ? data.results->groups.size() : 0;
  const TextStyle soft{.colour = Colour::kSoft, .align = Align::kCentre, .wrap = true};
  const std::string words =
      tr("{} curves have {} pairs of thresholds at each level. To compare them all takes a "
         "while.",
         groups, groups * (groups - 1) / 2);
  const float of_words = std::min(560.0f, place.width - 48);
  const float height = ui.text_height(of_words, words, soft);
  Rect middle = place.middle(of_words, height + 16 + 54);
  ui.text(middle.take_top(height, 16), words, soft);
  const ButtonStyle style{.tone = Tone::kPrimary, .key = {Key::kEnter}};
  const float width = ui.button_width(tr("Compare"), style) + 24;
  if (ui.button("compare", middle.middle(width, 48), tr("Compare"), style)) {
    result.compare = true;
  }
}

}  // namespace

void draw_data_comparison(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                          DataViewResult& result) {
  Rect inside = draw_card(ui, place, tr("Comparison of the curves"));
  if (!data.comparison) {
    if (data.is_computing) return draw_notice(ui, inside, tr("Fitting …"));
    if (data.is_comparing) return draw_notice(ui, inside, tr("Comparing …"));
    if (!data.compare_problem.empty()) {
      return draw_notice(ui, inside, data.compare_problem, Colour::kRed);
    }
    return draw_offer(ui, inside, data, result);
  }
  const DataComparison& comparison = *data.comparison;
  inside = ui.begin_scroll("comparison", inside, state.comparison_height);
  const float top = inside.y;
  if (!comparison.reason.empty()) {
    const TextStyle amber{.colour = Colour::kAmber, .wrap = true};
    ui.text(inside.take_top(ui.text_height(inside.width, comparison.reason, amber), 12),
            comparison.reason, amber);
  }
  for (const DataVerdict& verdict : comparison.verdicts) {
    const TextStyle style{.font = verdict.differs ? Font::kStrong : Font::kBody,
                          .colour = verdict.differs ? Colour::kInk : Colour::kSoft,
                          .wrap = true};
    ui.text(inside.take_top(ui.text_height(inside.width, verdict.sentence, style), 6),
            verdict.sentence, style);
  }
  if (!comparison.contrasts.empty()) {
    inside.take_top(14);
    ui.heading(inside.take_top(18, 2), tr("Thresholds, pair by pair"));
    draw_contrasts(ui, inside, comparison);
  }
  if (!comparison.models.empty()) {
    inside.take_top(20);
    ui.heading(inside.take_top(18, 2), tr("What the curves may share"));
    draw_models(ui, inside, comparison);
  }
  state.comparison_height = inside.y - top;
  ui.end_scroll();
}

}  // namespace jnd::app::gui
