#include "app/gui/views/start_view.h"

#include <algorithm>

#include "app/gui/views/layout.h"
#include "app/gui/views/list_keys.h"
#include "app/gui/views/start_dialogs.h"
#include "app/gui/views/study_tabs.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kStudyCard = 76;
constexpr float kBetweenCards = 12;
bool is_small(const Ui& ui) { return ui.screen().height < 860; }
float gap_between_groups(const Ui& ui) { return is_small(ui) ? 14 : 2 * kGap; }
/// With so many cards, the studies still have room.
std::size_t most_resumes(const Ui& ui) { return is_small(ui) ? 1 : 2; }
constexpr std::size_t kMostKeys = 9;

struct Open {
  const StartModel::Study* study;
  const InterruptedSession* session;
};

/// Interrupted sessions; those of the study that was opened last come first.
std::vector<Open> interrupted_in(const StartModel& model) {
  std::vector<Open> all;
  for (const StartModel::Study& study : model.studies) {
    if (!study.folder) continue;
    for (const InterruptedSession& session : study.folder->interrupted) {
      all.push_back({&study, &session});
    }
  }
  return all;
}

std::string safe_words(const Open& open) {
  if (!open.session->problem.empty()) return open.session->problem;
  std::string words = open.study->title;
  if (!open.session->when.empty()) words += " · " + open.session->when;
  return words + " · " + open.session->safe() + ".";
}

/// Draws the card of an interrupted session. Returns its height.
float draw_resume_card(Ui& ui, const Rect& top, const Open& open, std::size_t place,
                       bool has_chosen, StartViewResult& result) {
  // While the arrow keys have reached a study, Enter opens that study instead.
  const Chord key =
      place == 0 && has_chosen ? Chord{} : Chord{.key = Key::kEnter, .control = place > 0};
  const ButtonStyle style{.tone = place == 0 ? Tone::kPrimary : Tone::kPlain, .key = key};
  const float button = ui.button_width(tr("Resume"), style);
  const TextStyle title{.font = Font::kLarge, .wrap = true};
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  const float width = top.width - 2 * kPadding - button - 20;
  const std::string sentence = open.session->sentence();
  const std::string safe = safe_words(open);
  const float title_height = ui.text_height(width, sentence, title);
  const float height = title_height + 4 + ui.text_height(width, safe, soft) + 2 * kPadding;
  const Rect card{top.x, top.y, top.width, height};
  ui.fill(card, Colour::kCard, 10);
  ui.outline(card, Colour::kAmber, 10, 1.5f);
  Rect inside = card.inset(kPadding);
  const Rect at_right = inside.take_right(button, 20);
  ui.text(inside.take_top(title_height, 4), sentence, title);
  ui.text(inside, safe, soft);
  const std::string name = "resume_" + std::to_string(place + 1);
  if (ui.button(name, at_right.middle(button, 48), tr("Resume"), style)) {
    result.resume = {open.study->folder->folder, open.session->session};
  }
  return height;
}

/// Draws the cards of interrupted sessions. Returns the height of all.
float draw_resume_cards(Ui& ui, Rect column, const StartModel& model,
                        const StartViewState& state, StartViewResult& result) {
  const std::vector<Open> all = interrupted_in(model);
  if (all.empty()) return 0;
  constexpr float kHeading = 28;
  ui.heading(column.take_top(kHeading - 10, 10), tr("Interrupted"));
  float height = kHeading;
  for (std::size_t i = 0; i < std::min(all.size(), most_resumes(ui)); ++i) {
    const float card =
        draw_resume_card(ui, column, all[i], i, state.study.has_value(), result) +
        kBetweenCards;
    column.take_top(card);
    height += card;
  }
  if (all.size() <= most_resumes(ui)) return height;
  const std::size_t others = all.size() - most_resumes(ui);
  ui.text(column.take_top(24),
          trn("{} more session can be resumed from its study.",
              "{} more sessions can be resumed from their studies.", others),
          {.font = Font::kSmall, .colour = Colour::kSoft});
  return height + 24;
}

void draw_study_card(Ui& ui, const Rect& card, const StartModel::Study& study,
                     std::size_t place, bool is_chosen, StartViewResult& result) {
  const Chord key = place < kMostKeys ? Chord{letter(static_cast<char>('1' + place))} : Chord{};
  ui.card(card);
  if (is_chosen) {
    ui.fill(card, Colour::kBlueSoft, 10);
    ui.outline(card, Colour::kBlue, 10, 1.5f);
  }
  if (ui.row("study_" + std::to_string(place + 1), card, study.title, key) ||
      (is_chosen && ui.pressed({Key::kEnter}))) {
    result.open = study.path;
  }
  Rect inside = card.inset(kPadding);
  const Chord shown = is_chosen ? Chord{Key::kEnter} : key;
  if (shown.key != Key::kNone) {
    const Rect cap = inside.take_right(ui.key_cap_width(shown), 16);
    ui.key_cap(cap.x, cap.y + (cap.height - 20) / 2, shown);
  }
  // A long summary takes two lines.
  const bool is_long = ui.text_width(study.summary, Font::kSmall) > inside.width;
  inside = inside.middle(inside.width, is_long ? 56 : 44);
  ui.text(inside.take_top(22), study.title, {.font = Font::kStrong, .any_length = true});
  ui.text(inside, study.summary, {.colour = Colour::kSoft});
}

void draw_studies(Ui& ui, Rect column, const StartModel& model, StartViewState& state,
                  StartViewResult& result) {
  Rect heading = column.take_top(18, 10);
  if (model.studies.size() > 1) draw_list_keys(ui, heading);
  ui.heading(heading, tr("Studies"));
  Rect buttons = column.take_bottom(46, kGap);
  if (model.studies.empty()) {
    const Rect note = column.take_top(52);
    ui.text(note, tr("No study was opened yet. Take the tour, or begin a new study."),
            {.colour = Colour::kSoft, .wrap = true});
    buttons.y = column.y + 8;
  } else {
    const float content =
        static_cast<float>(model.studies.size()) * (kStudyCard + kBetweenCards) - kBetweenCards;
    Rect list = column;
    list.height = std::min(column.height, content);
    Rect inside = ui.begin_scroll("studies", list, content);
    for (std::size_t i = 0; i < model.studies.size(); ++i) {
      draw_study_card(ui, inside.take_top(kStudyCard, kBetweenCards), model.studies[i], i,
                      state.study == i, result);
    }
    ui.end_scroll();
    buttons.y = list.bottom() + kGap;
  }
  const ButtonStyle new_style{.key = {letter('N'), true}};
  const ButtonStyle open_style{.key = {letter('O'), true}};
  if (ui.button("new_study", buttons.take_left(ui.button_width(tr("New study"), new_style), 12),
                tr("New study"), new_style)) {
    open_new_dialog(model, state);
  }
  if (ui.button("open_study", buttons.take_left(ui.button_width(tr("Open study"), open_style)),
                tr("Open study"), open_style)) {
    open_open_dialog(state);
  }
}

void draw_tour(Ui& ui, Rect& column, StartViewResult& result) {
  ui.heading(column.take_top(18, 10), tr("Try it now, without a robot"));
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const std::string_view words =
      tr("Move the mouse through virtual fluids, say which is thicker, and see your own Weber "
         "fraction.");
  const float width = column.width - 2 * kPadding;
  const float text = ui.text_height(width, words, soft);
  const float gap = is_small(ui) ? 12 : 16, button = is_small(ui) ? 46 : 50;
  const Rect card =
      column.take_top(30 + text + gap + button + 2 * kPadding, gap_between_groups(ui));
  ui.card(card);
  Rect inside = card.inset(kPadding);
  ui.text(inside.take_top(30), tr("A three-minute tour"), {.font = Font::kLarge});
  ui.text(inside.take_top(text, gap), words, soft);
  if (ui.button("start_tour", inside.take_top(button), tr("Start the tour"),
                {.tone = Tone::kPrimary, .key = {letter('T')}})) {
    result.start_tour = true;
  }
}

/// Draws the entry for people who already have answers, wherever they come from.
void draw_own_data(Ui& ui, Rect& column, StartViewResult& result) {
  ui.heading(column.take_top(18, 10), tr("Your own data"));
  const Rect card = column.take_top(is_small(ui) ? 64 : kStudyCard, gap_between_groups(ui));
  const Chord key{letter('C')};
  ui.card(card);
  if (ui.row("open_data", card, tr("Open data"), key)) result.data = true;
  Rect inside = card.inset(kPadding);
  const Rect cap = inside.take_right(ui.key_cap_width(key), 16);
  ui.key_cap(cap.x, cap.y + (cap.height - 20) / 2, key);
  inside = inside.middle(inside.width, 44);
  ui.text(inside.take_top(22), tr("Open data"), {.font = Font::kStrong});
  ui.text(inside, tr("Psychometric functions from CSV, TSV or jsPsych"),
          {.colour = Colour::kSoft});
}

void draw_machine(Ui& ui, Rect column, const StartModel& model, StartViewResult& result) {
  Rect heading = column.take_top(18, 10);
  const ButtonStyle device{.tone = Tone::kQuiet, .key = {letter('D')}};
  const Rect button = heading.take_right(ui.button_width(tr("Device"), device), 12);
  if (ui.button("device", {button.x, button.y - 8, button.width, 32}, tr("Device"), device)) {
    result.device = true;
  }
  ui.heading(heading, tr("This machine"));
  const float line_height = is_small(ui) ? 28 : 34;
  const std::size_t count = std::max<std::size_t>(1, model.machine.size());
  const float content = static_cast<float>(count) * line_height;
  const Rect card = column.take_top(std::min(content + 2 * 10, column.height));
  ui.card(card);
  Rect inside = card;
  inside.take_left(kPadding);
  inside.take_right(kPadding);
  inside.take_top(10);
  inside.take_bottom(10);
  inside = ui.begin_scroll("machine", inside, content);
  if (model.machine.empty()) {
    ui.text(inside.take_top(line_height), tr("Looking …"),
            {.font = Font::kSmall, .colour = Colour::kSoft});
  }
  for (std::size_t i = 0; i < model.machine.size(); ++i) {
    const PreflightLine& line = model.machine[i];
    const Rect row = inside.take_top(line_height);
    draw_name_and_value(ui, row, line.name, {.font = Font::kSmall}, line.found,
                        {.font = Font::kSmall, .colour = colour_of(line.status)});
    if (i + 1 < model.machine.size()) {
      ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
    }
    if (!line.remedy.empty() && ui.hovered(row)) {
      ui.tooltip(ui.mouse_x(), ui.mouse_y(), line.remedy);
    }
  }
  ui.end_scroll();
}

}  // namespace

StudyTabLook tab_of_start() { return {StudyTab::kStart, "tab_start", tr_later("Start"), '0'}; }

StartViewResult draw_start_view(Ui& ui, const StartModel& model, const EntriesOf& entries_of,
                                StartViewState& state) {
  StartViewResult result;
  Rect rest = ui.screen();
  const Rect footer = rest.take_bottom(kFooterHeight);
  const float margin = std::clamp(rest.width * 0.056f, 24.0f, 90.0f);
  rest.take_left(margin);
  rest.take_right(margin);
  rest.take_top(std::clamp(rest.height * 0.055f, 20.0f, 54.0f));
  rest.take_bottom(kGap);
  ui.text(rest.take_top(54, 4), "jnd", {.font = Font::kHuge});
  ui.text(rest.take_top(28, 26), tr("A haptic psychophysics laboratory"),
          {.font = Font::kBody, .colour = Colour::kSoft});
  constexpr float kBetweenColumns = 48;
  Rect left = rest.take_left((rest.width - kBetweenColumns) / 2, kBetweenColumns);
  Rect right = rest;
  // The list's keys come first, because Enter's meaning depends on them.
  if (move_in_list(ui, model.studies.size(), state.study)) {
    ui.scroll_into_view(
        "studies", (kStudyCard + kBetweenCards) * static_cast<float>(*state.study), kStudyCard);
  }
  const float resumes = draw_resume_cards(ui, left, model, state, result);
  if (resumes > 0) left.take_top(resumes + kBetweenCards);
  draw_studies(ui, left, model, state, result);
  draw_tour(ui, right, result);
  draw_own_data(ui, right, result);
  draw_machine(ui, right, model, result);
  draw_study_footer(ui, footer, tr("Version {}", model.version), "");
  switch (state.dialog) {
    case StartViewState::Dialog::kNew:
      draw_new_dialog(ui, model, state, result);
      break;
    case StartViewState::Dialog::kOpen:
      draw_open_dialog(ui, entries_of, state, result);
      break;
    case StartViewState::Dialog::kBrowse:
      draw_browse_dialog(ui, entries_of, state);
      break;
    case StartViewState::Dialog::kNone:
      break;
  }
  return result;
}

}  // namespace jnd::app::gui
