#include "app/gui/views/run_view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/gui/views/layout.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {

namespace {

constexpr float kFooter = 40;

/// The sides become narrower before the card in the middle does.
float left_width(float width) { return width < 1400 ? 188.0f : 236.0f; }
float right_width(float width) {
  return width < 1400 ? 280.0f : std::min(width * 0.282f, 480.0f);
}

}  // namespace

std::string clock_words(double seconds) {
  const auto whole = static_cast<long>(std::max(0.0, seconds));
  char text[32];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60,
                  whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  }
  return text;
}

std::string about_words(double seconds) {
  if (seconds < 55) return tr("{} s", std::lround(seconds / 5) * 5);
  return tr("{} min", std::lround(seconds / 60));
}

std::string in_quotes(std::string_view words) {
  return words.empty() ? "" : "“" + std::string(words) + "”";
}

void open_dialog(RunViewState& state, RunViewState::Dialog dialog) {
  state.dialog = dialog;
  state.dialog_is_new = true;
  state.reason.clear();
  state.writes_reason = false;
}

void ask_why_paused(const SessionView& view, RunViewState& state) {
  if (!state.asked_to_pause || view.step != Step::kPaused || !view.asks_why_paused) return;
  if (state.dialog != RunViewState::Dialog::kNone) return;
  state.asked_to_pause = false;
  open_dialog(state, RunViewState::Dialog::kWhyPaused);
}

void ask_to_leave(RunViewState& state) { open_dialog(state, RunViewState::Dialog::kLeave); }

RunViewResult draw_run_view(Ui& ui, const SessionView& view,
                            const std::vector<TracePoint>& trace, AfterSession& after,
                            RunViewState& state) {
  RunViewResult result;
  Rect rest = ui.screen();
  state.pad = {};
  const Rect header = rest.take_top(kRunHeader);
  const Rect footer = rest.take_bottom(kFooter);
  rest = rest.inset(kGap);
  draw_stage_list(ui, rest.take_left(left_width(ui.screen().width), kGap), view);
  // A participant who is alone could read the answer from this panel.
  if (ui.screen().width >= 1000 && !view.is_alone) {
    draw_live_panel(ui, rest.take_right(right_width(ui.screen().width), kGap), view, trace);
  }
  draw_progress_card(ui, rest.take_top(64, kGap), view);
  draw_answers(ui,
               rest.take_bottom(std::clamp(rest.height * 0.235f - 40.0f, 96.0f, 196.0f), kGap),
               view, state);
  draw_run_card(ui, rest, view, trace, after, state, result);
  draw_run_header(ui, header, view, state, result);
  draw_run_footer(ui, footer, view);
  if (view.pilot) ui.outline(ui.screen().inset(2), Colour::kPilot, 0, 4);
  ask_why_paused(view, state);
  const bool has_dialog = state.dialog != RunViewState::Dialog::kNone;
  if (has_dialog) {
    draw_run_dialog(ui, view, state, result);
  } else if (view.doubt) {
    draw_doubt_dialog(ui, *view.doubt, result);
  }
  if (!state.is_covered) result.stop = draw_emergency_stop(ui);
  // A field that is shown again, after a stop or a dialog, gets the keyboard again.
  const bool has_item =
      view.step == Step::kItem || view.step == Step::kFeeling || view.step == Step::kStageDone;
  if (!has_item || state.is_covered || has_dialog) {
    state.item_is_new = true;
  }
  return result;
}

}  // namespace jnd::app::gui
