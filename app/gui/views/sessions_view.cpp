#include "app/gui/views/sessions_view.h"

#include <algorithm>

#include "app/gui/views/backup_dialog.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/work_line.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kSessionHeight = 38;
/// The distance from the dot of a state to its word.
constexpr float kAfterDot = 17;

const InterruptedSession* interrupted_in(const StudyFolder& study, std::int64_t session) {
  for (const InterruptedSession& open : study.interrupted) {
    if (open.session == session) return &open;
  }
  return nullptr;
}

/// The selected session if it can be resumed; if none is selected, the one that was interrupted
/// last.
const InterruptedSession* resumable(const StudyFolder& study, std::int64_t selected) {
  if (selected != 0) return interrupted_in(study, selected);
  return study.interrupted.empty() ? nullptr : &study.interrupted.front();
}

struct StatusLook {
  const char* words;
  Colour colour;
};
StatusLook look_of(SessionLine::Status status) {
  switch (status) {
    case SessionLine::Status::kCompleted:
      return {tr("completed"), Colour::kGreen};
    case SessionLine::Status::kOpen:
      return {tr("open"), Colour::kAmber};
    case SessionLine::Status::kEndedEarly:
      return {tr("ended early"), Colour::kSoft};
  }
  return {"", Colour::kSoft};
}

std::string marks_of(const SessionLine& line) {
  std::string marks = line.pilot ? tr("pilot") : "";
  if (line.simulated) marks += (marks.empty() ? "" : ", ") + std::string(tr("simulated"));
  return marks;
}

constexpr float kBetweenColumns = 18;
constexpr std::size_t kDeviceColumn = 4;

std::vector<ColumnLook> all_columns_of(const Ui& ui, const StudyFolder& study) {
  std::vector<ColumnLook> columns = {{tr("Participant"), 1.05f},
                                     {tr("State"), 1.2f},
                                     {tr("Answers"), 1.05f, Align::kRight},
                                     {tr("When"), 1.1f},
                                     {tr("Device"), 0.75f}};
  if (!study.hides_levels) columns.push_back({tr("Order"), 2.0f});
  columns.push_back({tr("Marks"), 1.0f});
  need_room_for_titles(ui, columns);
  // If there are very many sessions, these are enough to know how long the words are.
  constexpr std::size_t kMostLooked = 60;
  constexpr float kMostOrder = 150;
  const std::size_t order = study.hides_levels ? columns.size() : columns.size() - 2;
  for (std::size_t i = 0; i < std::min(kMostLooked, study.sessions.size()); ++i) {
    const SessionLine& line = study.sessions[i];
    need_room(ui, columns[1], look_of(line.status).words, Font::kSmall);
    if (line.pilot) need_room(ui, columns.back(), tr("pilot"), Font::kSmall);
    if (line.simulated) need_room(ui, columns.back(), tr("simulated"), Font::kSmall);
    if (order < columns.size()) {
      const float wanted = ui.text_width(line.cells, Font::kSmall) + 1;
      columns[order].least_width =
          std::max(columns[order].least_width, std::min(wanted, kMostOrder));
    }
  }
  columns[1].least_width += kAfterDot;
  need_room(ui, columns[2], as_is("000/000"), Font::kMono);
  need_room(ui, columns[3], as_is("00.00. 00:00"), Font::kSmall);
  return columns;
}

/// The columns of a table of this width. The device is left out first if the other columns have
/// too little room, because the session's page shows it, too.
std::vector<ColumnLook> columns_of(const Ui& ui, const StudyFolder& study, float width,
                                   bool& has_device) {
  std::vector<ColumnLook> columns = all_columns_of(ui, study);
  float least = -kBetweenColumns;
  for (const ColumnLook& column : columns) least += column.least_width + kBetweenColumns;
  has_device = least <= width;
  if (!has_device) columns.erase(columns.begin() + kDeviceColumn);
  return columns;
}

void draw_session(Ui& ui, const Rect& row, const StudyFolder& study, const SessionLine& line,
                  SessionsViewState& state, SessionsViewResult& result) {
  if (line.session == state.selected) ui.fill(row, Colour::kBlueSoft, 8);
  const std::string name = "session_" + std::to_string(line.session);
  if (ui.row(name, row, line.participant)) {
    state.selected = line.session;
    if (state.clicks.clicked(name, ui.time_s())) result.show = line.session;
  }
  Rect inside = row;
  inside.take_left(8);
  inside.take_right(8);
  bool has_device = true;
  const std::vector<ColumnLook> columns = columns_of(ui, study, inside.width, has_device);
  const std::vector<Rect> cells = cells_of(inside, columns, kBetweenColumns);
  ui.text(cells[0], line.participant, {.font = Font::kStrong, .any_length = true});
  const StatusLook look = look_of(line.status);
  Rect status = cells[1];
  ui.dot(status.x + 5, status.y + status.height / 2, 4.5f, look.colour);
  status.take_left(kAfterDot);
  ui.text(status, look.words, {.colour = look.colour});
  const std::string answers = line.num_is_expected
                                  ? tr("{} of about {}", line.num_answers, line.num_trials)
                                  : tr("{} of {}", line.num_answers, line.num_trials);
  ui.text(cells[2], answers, {.font = Font::kMono, .align = Align::kRight});
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .any_length = true};
  ui.text(cells[3], line.when.empty() ? "-" : line.when, soft);
  std::size_t next = kDeviceColumn;
  if (has_device) ui.text(cells[next++], line.device, soft);
  if (!study.hides_levels) ui.text(cells[next++], line.cells.empty() ? "-" : line.cells, soft);
  ui.text(cells[next], marks_of(line), {.font = Font::kSmall, .colour = Colour::kAmber});
}

/// The arrow keys go through the rows; the caps of the keys are drawn at the heading.
void move_selection(Ui& ui, const StudyFolder& study, SessionsViewState& state) {
  const auto found = std::ranges::find(study.sessions, state.selected, &SessionLine::session);
  std::optional<std::size_t> place;
  if (found != study.sessions.end()) {
    place = static_cast<std::size_t>(found - study.sessions.begin());
  }
  if (!move_in_list(ui, study.sessions.size(), place)) return;
  state.selected = study.sessions[*place].session;
  ui.scroll_into_view("sessions", kSessionHeight * static_cast<float>(*place), kSessionHeight);
}

void draw_table(Ui& ui, const Rect& place, const StudyFolder& study, SessionsViewState& state,
                SessionsViewResult& result) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  Rect title = inside.take_top(28, 4);
  if (!study.sessions.empty()) {
    const ButtonStyle show{
        .tone = Tone::kQuiet, .key = {Key::kEnter}, .enabled = state.selected != 0};
    const Rect button = title.take_right(ui.button_width(tr("Show session"), show), 12);
    if (ui.button("show_session", button, tr("Show session"), show)) {
      result.show = state.selected;
    }
  }
  if (study.sessions.size() > 1) draw_list_keys(ui, title);
  ui.heading(title.middle(title.width, 18), tr("Sessions"));
  if (study.sessions.empty()) {
    draw_notice(ui, inside, tr("No session yet. Begin the first one with “New session”."));
    return;
  }
  const float content = kSessionHeight * static_cast<float>(study.sessions.size());
  constexpr float kHead = 30;
  const bool scrolls = content > inside.height - kHead;
  Rect head = inside;
  head.take_left(8);
  head.take_right(scrolls ? 24 : 8);
  bool has_device = true;
  draw_table_head(ui, head, columns_of(ui, study, head.width, has_device));
  inside.take_top(kHead);
  move_selection(ui, study, state);
  Rect rows = ui.begin_scroll("sessions", inside, content);
  for (const SessionLine& line : study.sessions) {
    const Rect row = rows.take_top(kSessionHeight);
    draw_session(ui, row, study, line, state, result);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
  ui.end_scroll();
}

bool is_low(const Ui& ui) { return ui.screen().height < 760; }
float height_of_fact(const Ui& ui) { return is_low(ui) ? 25 : 28; }

/// Draws a name in soft letters and its value in strong ones.
void draw_fact(Ui& ui, Rect& inside, const std::string& name, const std::string& value,
               Colour colour = Colour::kInk) {
  draw_name_and_value(ui, inside.take_top(height_of_fact(ui)), name, {.colour = Colour::kSoft},
                      value, {.font = Font::kStrong, .colour = colour});
}

void draw_study_card(Ui& ui, Rect& column, const StudyFolder& study,
                     SessionsViewResult& result) {
  const bool blind = study.blinding == experiments::Blinding::kDouble;
  const float lines = 5.0f + (blind ? 1.0f : 0.0f);
  Rect inside =
      draw_card(ui, column.take_top(34 + height_of_fact(ui) * lines + 2 * kPadding, kGap), "");
  Rect head = inside.take_top(28, 6);
  const ButtonStyle overview{.tone = Tone::kQuiet, .key = {letter('O')}};
  const Rect button = head.take_right(ui.button_width(tr("Overview"), overview), 12);
  if (ui.button("overview", button, tr("Overview"), overview)) result.tab = StudyTab::kOverview;
  ui.heading(head.middle(head.width, 18), tr("This study"));
  draw_fact(ui, inside, tr("Participants done"), std::to_string(study.num_participants_done));
  draw_fact(ui, inside, tr("Open sessions"), std::to_string(study.num_open));
  draw_fact(ui, inside, tr("Pilots"), std::to_string(study.num_pilots));
  draw_fact(ui, inside, tr("Last session"),
            study.last_session.empty() ? "-" : study.last_session);
  const bool is_at_risk = !study.backups.empty() && !study.is_safe_elsewhere;
  draw_fact(ui, inside, tr("Backups known"),
            is_at_risk ? tr("{}, none on another disk", study.backups.size())
                       : std::to_string(study.backups.size()),
            is_at_risk ? Colour::kAmber : Colour::kInk);
  if (blind)
    draw_fact(ui, inside, tr("Double-blind"),
              study.hides_levels ? tr("levels hidden") : tr("unblinded"));
}

void ask_for_backup(SessionsViewState& state) {
  state.asks_for_backup = true;
  state.dialog_is_new = true;
}

void draw_actions(Ui& ui, Rect& column, const StudyFolder& study, const StudyWork& work,
                  SessionsViewState& state, SessionsViewResult& result) {
  const InterruptedSession* open = resumable(study, state.selected);
  const bool idle = work.running.empty();
  if (open != nullptr) {
    const std::string sentence = open->sentence() + ".";
    const std::string safe = open->problem.empty() ? open->safe() + "." : open->problem;
    const TextStyle strong{.font = Font::kStrong, .wrap = true};
    const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
    const float width = column.width - 2 * kPadding;
    const float text = ui.text_height(width, sentence, strong);
    const float small = ui.text_height(width, safe, soft);
    const float button = is_low(ui) ? 42 : 48;
    const Rect card = column.take_top(text + small + 4 + 14 + button + 2 * kPadding, kGap);
    ui.fill(card, Colour::kCard, 10);
    ui.outline(card, Colour::kAmber, 10, 1.5f);
    Rect inside = card.inset(kPadding);
    ui.text(inside.take_top(text, 4), sentence, strong);
    ui.text(inside.take_top(small, 14), safe, soft);
    if (ui.button("resume", inside, tr("Resume {}", open->participant),
                  {.tone = Tone::kPrimary, .key = {letter('R')}})) {
      result.resume = open->session;
    }
  }
  if (study.is_backup) {
    const std::string words =
        tr("This folder is a backup. It can be read and checked; sessions are run in the study "
           "itself. Where that is lost, `jnd restore` makes a study of the backup.");
    const TextStyle soft{.colour = Colour::kAmber, .wrap = true};
    ui.text(column.take_top(ui.text_height(column.width, words, soft), kGap), words, soft);
  } else if (ui.button("new_session", column.take_top(is_low(ui) ? 50 : 60, 12),
                       tr("New session"),
                       {.tone = open == nullptr ? Tone::kPrimary : Tone::kPlain,
                        .key = {letter('N')},
                        .large = true})) {
    result.new_session = true;
  }
  Rect pair = column.take_top(46, kGap);
  const Rect verify = pair.take_left((pair.width - 12) / 2, 12);
  const bool has_sessions = !study.sessions.empty();
  if (ui.button("verify", verify, tr("Verify"),
                {.key = {letter('V')}, .enabled = idle && has_sessions})) {
    result.verify = true;
  }
  if (ui.button("back_up", pair, tr("Back up"),
                {.key = {letter('B')}, .enabled = idle && !study.is_backup})) {
    ask_for_backup(state);
  }
  const Rect work_place = column.take_top(work_height(ui, column.width, work));
  if (draw_work(ui, work_place, work)) result.cancel = true;
}

}  // namespace

StudyTabLook tab_of_sessions() {
  return {StudyTab::kSessions, "tab_sessions", tr_later("Sessions"), '1'};
}

SessionsViewResult draw_sessions_view(Ui& ui, const StudyFolder& study, const StudyWork& work,
                                      SessionsViewState& state) {
  SessionsViewResult result;
  Rect rest = ui.screen();
  result.tab =
      draw_study_header(ui, rest.take_top(kHeaderHeight), study, StudyTab::kSessions).chosen;
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  Rect column = rest.take_right(std::clamp(rest.width * 0.27f, 320.0f, 420.0f), kGap);
  draw_table(ui, rest, study, state, result);
  column = ui.begin_scroll("beside_sessions", column, state.column_height);
  const float top = column.y;
  draw_study_card(ui, column, study, result);
  draw_actions(ui, column, study, work, state, result);
  state.column_height = column.y - top;
  ui.end_scroll();
  draw_study_footer(ui, footer, work.outcome.sentence,
                    trn("{} session", "{} sessions", study.num_sessions));
  result.back_up =
      draw_backup_dialog(ui, state.asks_for_backup, state.dialog_is_new, state.backup_folder);
  return result;
}

}  // namespace jnd::app::gui
