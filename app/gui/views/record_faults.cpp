// Shows the faults of a session, and the last second before each.

#include <algorithm>

#include "app/gui/plot.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/record_parts.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

PlotModel last_second(const char* title, const char* unit, const std::vector<double>& times_s,
                      const std::vector<double>& values, Colour colour) {
  PlotModel plot{.title = title,
                 .unit = unit,
                 .x = {.label = tr("before the fault"), .unit = as_is("s")},
                 .y = {.minimum = 0.0},
                 .series = {},
                 .boxes = {},
                 .marks = {},
                 .least_left = 40};
  plot.series.push_back({.colour = colour, .x = times_s, .y = values});
  return plot;
}

void draw_flight(Ui& ui, Rect place, const RecordViewModel& model, const RecordFault& fault,
                 RecordViewResult& result) {
  Rect head = place.take_top(40, 8);
  if (!fault.flight_record.empty()) {
    const ButtonStyle open{.key = {letter('O')}};
    const Rect at_right = head.take_right(ui.button_width(tr("Open the table"), open), 12);
    if (ui.button("open_flight", at_right, tr("Open the table"), open)) {
      result.open = fault.flight_record;
    }
  }
  ui.heading(head.middle(head.width, 18), tr("The last second before it"));
  if (model.record->hides_levels) {
    draw_notice(ui, place,
                tr("What was recorded before it would tell what the study hides. It is here "
                   "once somebody has unblinded the study."));
  } else if (fault.flight_record.empty()) {
    draw_notice(ui, place, tr("Nothing was kept of the last second before this fault."));
  } else if (!model.flight_problem.empty()) {
    draw_notice(ui, place, model.flight_problem, Colour::kRed);
  } else if (model.flight != nullptr) {
    Rect left = place.take_left((place.width - 24) / 2, 24);
    (void)draw_plot(ui, left,
                    last_second(tr("Force on the hand"), as_is("N"), model.flight->time_s,
                                model.flight->force_n, Colour::kBlue));
    (void)draw_plot(ui, place,
                    last_second(tr("Fastest point"), as_is("m/s"), model.flight->time_s,
                                model.flight->speed_m_per_s, Colour::kAmber));
  }
}

float height_of_fault(const Ui& ui, float width, const RecordFault& fault) {
  return ui.text_height(width - 100, fault.words, {.wrap = true}) + 24 + 16;
}

void draw_fault(Ui& ui, const Rect& row, const RecordFault& fault, std::size_t place,
                RecordViewState& state) {
  if (state.fault == place) ui.fill(row, Colour::kBlueSoft, 8);
  if (ui.row("fault_" + std::to_string(place + 1), row, fault.words)) state.fault = place;
  Rect inside = row;
  inside.take_left(8);
  inside.take_right(8);
  inside.take_top(8);
  Rect clock = inside.take_left(72, 12);
  ui.text(clock.take_top(ui.line_height(Font::kBody)), clock_words(fault.at_s),
          {.font = Font::kMono, .colour = Colour::kRed});
  ui.text(inside.take_top(ui.text_height(inside.width, fault.words, {.wrap = true})),
          fault.words, {.wrap = true});
  ui.text(inside.take_top(24), fault.where,
          {.font = Font::kSmall, .colour = Colour::kSoft, .any_length = true});
}

}  // namespace

void draw_record_faults(Ui& ui, const Rect& place, const RecordViewModel& model,
                        RecordViewState& state, RecordViewResult& result) {
  const SessionRecord& record = *model.record;
  ui.card(place);
  Rect inside = place.inset(kPadding);
  Rect title = inside.take_top(20, 8);
  if (record.faults.size() > 1) draw_list_keys(ui, title);
  ui.heading(title, tr("Faults and stops"));
  std::string warnings;
  for (const std::string& words : record.warnings) {
    warnings += (warnings.empty() ? "" : "; ") + words;
  }
  if (!warnings.empty()) {
    const TextStyle style{.font = Font::kSmall, .colour = Colour::kAmber, .wrap = true};
    warnings = tr("Guards of the loop: {}.", warnings);
    ui.text(inside.take_bottom(ui.text_height(inside.width, warnings, style), 8), warnings,
            style);
  }
  if (record.faults.empty()) {
    draw_notice(ui, inside,
                tr("No fault and no stop. Whatever takes the force away is listed here, with "
                   "the last second before it."));
    return;
  }
  if (!state.fault) state.fault = 0;
  const bool moved = move_in_list(ui, record.faults.size(), state.fault);
  float content = 0, chosen_from = 0, chosen_height = 0;
  for (std::size_t i = 0; i < record.faults.size(); ++i) {
    const float height = height_of_fault(ui, inside.width - 16, record.faults[i]);
    if (state.fault == i) {
      chosen_from = content;
      chosen_height = height;
    }
    content += height;
  }
  // The last second gets the room that the list leaves.
  const Rect list = inside.take_top(std::min(content, inside.height * 0.45f), 16);
  const Rect below = inside.take_top(std::min(inside.height, 340.0f));
  if (moved) ui.scroll_into_view("faults", chosen_from, chosen_height);
  Rect rows = ui.begin_scroll("faults", list, content);
  for (std::size_t i = 0; i < record.faults.size(); ++i) {
    const Rect row = rows.take_top(height_of_fault(ui, inside.width - 16, record.faults[i]));
    draw_fault(ui, row, record.faults[i], i, state);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
  ui.end_scroll();
  draw_flight(ui, below, model, record.faults[*state.fault], result);
}

}  // namespace jnd::app::gui
