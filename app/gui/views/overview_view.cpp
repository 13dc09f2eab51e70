#include "app/gui/views/overview_view.h"

#include <algorithm>

#include "app/gui/views/backup_dialog.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/overview_parts.h"
#include "app/gui/views/work_line.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

void draw_while_reading(Ui& ui, const Rect& place, const OverviewModel& model) {
  ui.card(place);
  if (!model.problem.empty()) return draw_notice(ui, place, model.problem, Colour::kRed);
  Rect middle = place.middle(std::min(420.0f, place.width - 64), 70);
  ui.text(middle.take_top(34, 10), tr("Looking through the sessions …"),
          {.font = Font::kLarge, .align = Align::kCentre});
  ui.progress(middle.take_top(8), model.progress);
}

/// Left and Right choose the list through which Up and Down move.
void choose_list(Ui& ui, const StudyOverview& overview, OverviewState& state) {
  using List = OverviewState::List;
  if (ui.pressed({Key::kLeft})) state.list = List::kSessions;
  if (ui.pressed({Key::kRight})) state.list = List::kSchedule;
  if (overview.schedule.empty()) state.list = List::kSessions;
  if (overview.quality.empty() && !overview.schedule.empty()) state.list = List::kSchedule;
}

}  // namespace

OverviewResult draw_overview(Ui& ui, const OverviewModel& model, OverviewState& state) {
  OverviewResult result;
  Rect rest = ui.screen();
  result.tab =
      draw_study_header(ui, rest.take_top(kHeaderHeight), model.study, StudyTab::kSessions)
          .chosen;
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  if (model.overview == nullptr) {
    draw_while_reading(ui, rest, model);
    draw_study_footer(ui, footer, "", "");
    return result;
  }
  const StudyOverview& overview = *model.overview;
  choose_list(ui, overview, state);
  Rect right = rest.take_right(std::clamp(rest.width * 0.38f, 380.0f, 600.0f), kGap);
  const float figures = std::clamp(rest.height * 0.42f, 206.0f, 236.0f);
  draw_overview_figures(ui, rest.take_top(figures, kGap), model, state, result);
  draw_quality(ui, rest, overview, state, result);
  if (!model.work.running.empty() || !model.work.outcome.problems.empty()) {
    Rect work = right.take_bottom(84, kGap);
    ui.card(work);
    if (draw_work(ui, work.inset(12), model.work)) result.cancel = true;
  }
  const float balance = balance_height(ui, right.width, overview);
  draw_balance(ui, right.take_top(std::min(balance, right.height * 0.5f), kGap), overview);
  draw_schedule(ui, right, model, state);
  draw_study_footer(ui, footer, model.work.outcome.sentence,
                    overview.hides_levels ? tr("orders hidden: double-blind") : "");
  draw_overview_dialog(ui, model, state, result);
  if (draw_backup_dialog(ui, state.asks_for_backup, state.backup_is_new, state.backup_folder)) {
    result.back_up = true;
  }
  return result;
}

}  // namespace jnd::app::gui
