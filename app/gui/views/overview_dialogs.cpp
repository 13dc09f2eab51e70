// The overview's dialogs: how many participants are planned, who comes when, and whether an
// appointment is cancelled.

#include <algorithm>

#include "app/gui/views/layout.h"
#include "app/gui/views/overview_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using OverviewDialog = OverviewState::Dialog;

/// Tells above the buttons why the last attempt failed.
void draw_why_not(Ui& ui, Rect& inside, const std::string& problem) {
  if (problem.empty()) return;
  const TextStyle style{.font = Font::kSmall, .colour = Colour::kRed, .wrap = true};
  ui.text(inside.take_bottom(ui.text_height(inside.width, problem, style), 8), problem, style);
}

bool end_with(Ui& ui, Rect& inside, const char* verb, bool ready, bool entered,
              OverviewState& state) {
  const Rect buttons = inside.take_bottom(48, 10);
  draw_why_not(ui, inside, state.problem);
  const DialogChoice choice = draw_dialog_buttons(ui, buttons, verb, ready, entered);
  ui.end_dialog();
  // Enter ends a field. If something is still missing, the field gets the keyboard again.
  state.dialog_is_new = entered && !choice.done;
  if (choice.done || choice.cancelled) state.dialog = OverviewDialog::kNone;
  return choice.done;
}

void draw_plan_dialog(Ui& ui, OverviewState& state, OverviewResult& result) {
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const char* words =
      tr("Participants with a complete session. It is written down with the study, and may be "
         "written down anew.");
  const float more = more_lines(ui, 560, words, soft, 2);
  Rect inside = ui.begin_dialog("plan_dialog", 560, 290 + more);
  ui.text(inside.take_top(34, 4), tr("How many are planned?"), {.font = Font::kLarge});
  ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 12), words, soft);
  const bool entered = ui.text_field("planned_number", inside.take_top(46, 10), state.number,
                                     tr("number of participants"), state.dialog_is_new);
  result.plan = end_with(ui, inside, tr("Write down"), !state.number.empty(), entered, state);
}

void draw_appointment_dialog(Ui& ui, OverviewState& state, OverviewResult& result) {
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const char* words =
      tr("A pseudonym alone: who it is stands in a list of your own, which is kept elsewhere.");
  const float more = more_lines(ui, 620, words, soft, 2);
  Rect inside = ui.begin_dialog("appointment_dialog", 620, 410 + more);
  ui.text(inside.take_top(34, 4), tr("Who comes when?"), {.font = Font::kLarge});
  ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 12), words, soft);
  ui.heading(inside.take_top(18, 6), tr("Pseudonym"));
  bool entered = ui.text_field("appointment_participant", inside.take_top(46, 12),
                               state.participant, tr("pseudonym"), state.dialog_is_new);
  Rect heads = inside.take_top(18, 6);
  Rect fields = inside.take_top(46, 10);
  const float half = (fields.width - 16) / 2;
  ui.heading(heads.take_left(half, 16), tr("Day"));
  ui.heading(heads, tr("Time"));
  entered |= ui.text_field("appointment_date", fields.take_left(half, 16), state.date,
                           as_is("2026-12-01"));
  entered |= ui.text_field("appointment_hour", fields, state.hour, as_is("14:30"));
  const bool ready = !state.participant.empty() && !state.date.empty() && !state.hour.empty();
  result.add_appointment = end_with(ui, inside, tr("Write down"), ready, entered, state);
}

void draw_cancel_dialog(Ui& ui, const StudyOverview& overview, OverviewState& state,
                        OverviewResult& result) {
  if (!state.appointment || *state.appointment >= overview.schedule.size()) {
    state.dialog = OverviewDialog::kNone;
    return;
  }
  const ScheduleLine& line = overview.schedule[*state.appointment];
  Rect inside = ui.begin_dialog("cancel_dialog", 560, 220);
  ui.text(inside.take_top(34, 6), tr("Cancel this appointment?"), {.font = Font::kLarge});
  ui.text(inside.take_top(26, 6), tr("{}, {}", line.participant, line.when),
          {.any_length = true});
  if (end_with(ui, inside, tr("Cancel it"), true, false, state)) {
    result.cancel_appointment = line.appointment;
  }
}

}  // namespace

void draw_overview_dialog(Ui& ui, const OverviewModel& model, OverviewState& state,
                          OverviewResult& result) {
  switch (state.dialog) {
    case OverviewDialog::kPlan:
      return draw_plan_dialog(ui, state, result);
    case OverviewDialog::kAppointment:
      return draw_appointment_dialog(ui, state, result);
    case OverviewDialog::kCancel:
      return draw_cancel_dialog(ui, *model.overview, state, result);
    case OverviewDialog::kNone:
      return;
  }
}

}  // namespace jnd::app::gui
