// The overview's lists: how well each session went, and who comes when.

#include <algorithm>
#include <string>

#include "app/gui/views/layout.h"
#include "app/gui/views/overview_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using List = OverviewState::List;
constexpr float kQualityRow = 36;
constexpr float kScheduleRow = 38;

std::vector<ColumnLook> columns_of_quality(const Ui& ui, const StudyOverview& overview) {
  std::vector<ColumnLook> columns = {{tr("Participant"), 1.1f},
                                     {tr("Missed ticks"), 1.0f, Align::kRight},
                                     {tr("Faults"), 0.7f, Align::kRight},
                                     {tr("Run again"), 0.8f, Align::kRight},
                                     {tr("Unlikely"), 0.8f, Align::kRight}};
  if (!overview.hides_levels) columns.push_back({tr("No stroke"), 0.8f, Align::kRight});
  need_room_for_titles(ui, columns);
  return columns;
}

std::string missed_words(const SessionQuality& quality) {
  if (quality.num_ticks == 0) return "-";
  if (quality.num_missed_ticks == 0) return tr("none");
  const double percent = 100.0 * static_cast<double>(quality.num_missed_ticks) /
                         static_cast<double>(quality.num_ticks);
  return percent < 0.01 ? std::string(as_is("< 0.01 %")) : formatted("%.2f %%", percent);
}

void draw_count(Ui& ui, const Rect& cell, int count, bool is_bad) {
  ui.text(cell, std::to_string(count),
          {.font = Font::kMono,
           .colour = count == 0 ? Colour::kSoft
                     : is_bad   ? Colour::kAmber
                                : Colour::kInk,
           .align = Align::kRight});
}

void draw_quality_row(Ui& ui, const Rect& row, const StudyOverview& overview, std::size_t index,
                      OverviewState& state, OverviewResult& result) {
  const SessionQuality& quality = overview.quality[index];
  if (state.session == index) ui.fill(row, Colour::kBlueSoft, 8);
  const std::string name = "session_" + std::to_string(quality.session);
  if (ui.row(name, row, quality.participant)) {
    state.session = index;
    state.list = List::kSessions;
    if (state.clicks.clicked(name, ui.time_s())) result.session = quality.session;
  }
  Rect inside = row;
  inside.take_left(8);
  inside.take_right(8);
  const std::vector<Rect> cells = cells_of(inside, columns_of_quality(ui, overview));
  Rect who = cells[0];
  const Colour dot = quality.is_doubtful() ? Colour::kAmber : Colour::kGreen;
  ui.dot(who.x + 5, who.y + who.height / 2, 4.5f, dot);
  who.take_left(18);
  ui.text(who, quality.pilot ? tr("{}, pilot", quality.participant) : quality.participant,
          {.font = Font::kStrong, .any_length = true});
  if (!quality.problem.empty()) {
    const Rect words{cells[1].x, row.y, inside.right() - cells[1].x, row.height};
    ui.text(words, quality.problem,
            {.font = Font::kSmall, .colour = Colour::kRed, .any_length = true});
    return;
  }
  ui.text(cells[1], missed_words(quality),
          {.font = Font::kMono,
           .colour = quality.num_missed_ticks == 0 ? Colour::kSoft : Colour::kInk,
           .align = Align::kRight});
  draw_count(ui, cells[2], quality.num_faults, true);
  draw_count(ui, cells[3], quality.num_repeated, false);
  draw_count(ui, cells[4], quality.num_unlikely, true);
  if (!overview.hides_levels) draw_count(ui, cells[5], quality.num_unstroked, true);
}

struct ScheduleLook {
  const char* words;
  Colour colour;
};

ScheduleLook look_of_appointment(ScheduleLine::State state) {
  switch (state) {
    case ScheduleLine::State::kComing:
      return {tr("comes"), Colour::kBlue};
    case ScheduleLine::State::kCame:
      return {tr("came"), Colour::kGreen};
    case ScheduleLine::State::kMissed:
      return {tr("has not come"), Colour::kAmber};
  }
  return {"", Colour::kSoft};
}

void draw_schedule_row(Ui& ui, const Rect& row, const StudyOverview& overview,
                       std::size_t index, OverviewState& state) {
  const ScheduleLine& line = overview.schedule[index];
  if (state.appointment == index) ui.fill(row, Colour::kBlueSoft, 8);
  if (ui.row("appointment_" + std::to_string(line.appointment), row, line.participant)) {
    state.appointment = index;
    state.list = List::kSchedule;
  }
  Rect inside = row;
  inside.take_left(8);
  inside.take_right(8);
  const ScheduleLook look = look_of_appointment(line.state);
  ui.text(inside.take_left(inside.width * 0.24f, 10), line.participant,
          {.font = Font::kStrong, .any_length = true});
  const float width = ui.text_width(look.words, Font::kSmallStrong) + 2;
  ui.text(inside.take_right(width, 10), look.words,
          {.font = Font::kSmallStrong, .colour = look.colour, .align = Align::kRight});
  ui.text(inside, line.when, {.font = Font::kSmall});
}

}  // namespace

void draw_quality(Ui& ui, const Rect& place, const StudyOverview& overview,
                  OverviewState& state, OverviewResult& result) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  Rect title = inside.take_top(28, 6);
  const bool is_active = state.list == List::kSessions;
  const std::size_t count = overview.quality.size();
  const bool moved = is_active && move_in_list(ui, count, state.session);
  if (count > 0) {
    const ButtonStyle open{.tone = Tone::kQuiet,
                           .key = {Key::kEnter},
                           .enabled = is_active && state.session.has_value()};
    const Rect button = title.take_right(ui.button_width(tr("Show session"), open), 12);
    if (ui.button("show_session", button, tr("Show session"), open) && state.session) {
      result.session = overview.quality[*state.session].session;
    }
    if (is_active) draw_list_keys(ui, title);
  }
  ui.heading(title.middle(title.width, 18), tr("How the sessions went"));
  if (count == 0) {
    draw_notice(ui, inside,
                overview.is_backup
                    ? tr("No session is in this backup.")
                    : tr("No session yet. “Prepare the session” begins the first one."));
    return;
  }
  const float content = kQualityRow * static_cast<float>(count);
  constexpr float kHead = 30;
  Rect head = inside;
  head.take_left(8);
  head.take_right(content > inside.height - kHead ? 24 : 8);
  draw_table_head(ui, head, columns_of_quality(ui, overview));
  inside.take_top(kHead);
  if (moved) {
    ui.scroll_into_view("quality", kQualityRow * static_cast<float>(*state.session),
                        kQualityRow);
  }
  Rect rows = ui.begin_scroll("quality", inside, content);
  for (std::size_t i = 0; i < count; ++i) {
    const Rect row = rows.take_top(kQualityRow);
    draw_quality_row(ui, row, overview, i, state, result);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
  ui.end_scroll();
}

void draw_schedule(Ui& ui, const Rect& place, const OverviewModel& model,
                   OverviewState& state) {
  const StudyOverview& overview = *model.overview;
  ui.card(place);
  Rect inside = place.inset(kPadding);
  Rect title = inside.take_top(28, 6);
  const std::size_t count = overview.schedule.size();
  const bool is_active = state.list == List::kSchedule;
  const bool moved = is_active && move_in_list(ui, count, state.appointment);
  if (count > 0 && is_active) draw_list_keys(ui, title);
  ui.heading(title.middle(title.width, 18), tr("Who comes when"));
  Rect buttons = inside.take_bottom(42, 10);
  const Rect remove = buttons.take_right((buttons.width - 12) / 2, 12);
  if (ui.button("add_appointment", buttons, tr("Add"),
                {.key = {letter('A')}, .enabled = !overview.is_backup})) {
    state.dialog = OverviewState::Dialog::kAppointment;
    state.dialog_is_new = true;
    state.problem.clear();
    state.participant = overview.free_pseudonym;
    if (state.date.empty()) state.date = model.proposed_date;
    if (state.hour.empty()) state.hour = as_is("10:00");
  }
  const bool is_chosen = is_active && state.appointment && *state.appointment < count;
  if (ui.button("cancel_appointment", remove, tr("Cancel it"),
                {.key = {Key::kDelete}, .enabled = is_chosen && !overview.is_backup})) {
    state.dialog = OverviewState::Dialog::kCancel;
    state.problem.clear();
  }
  if (count == 0) {
    draw_notice(ui, inside,
                tr("Nobody is written down. “Add” notes who comes when, by pseudonym alone."));
    return;
  }
  if (moved) {
    ui.scroll_into_view("schedule", kScheduleRow * static_cast<float>(*state.appointment),
                        kScheduleRow);
  }
  Rect rows = ui.begin_scroll("schedule", inside, kScheduleRow * static_cast<float>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Rect row = rows.take_top(kScheduleRow);
    draw_schedule_row(ui, row, overview, i, state);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
  ui.end_scroll();
}

}  // namespace jnd::app::gui
