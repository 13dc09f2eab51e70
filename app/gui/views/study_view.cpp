#include "app/gui/views/study_view.h"

#include <algorithm>
#include <cmath>

#include "app/gui/views/layout.h"
#include "app/gui/views/study_problems.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr int kMostParticipants = 60;

/// Draws the header for a file alone, which has neither sessions nor results.
StudyTab draw_file_header(Ui& ui, const Rect& place, const StudyViewModel& model,
                          StudyViewState& state) {
  const StudyOutline& outline = model.outline;
  ui.fill(place, Colour::kCard);
  ui.line(place.x, place.bottom(), place.right(), place.bottom(), Colour::kLine);
  Rect strip = place;
  strip.take_left(20);
  strip.take_right(20);
  const ButtonStyle start{.tone = Tone::kQuiet, .key = {letter('0'), true}};
  const Rect tab = strip.take_right(ui.button_width(tr("Start"), start), 12);
  const bool chosen = ui.button("tab_start", tab.middle(tab.width, 36), tr("Start"), start);
  const ButtonStyle begin{
      .tone = Tone::kPrimary, .key = {letter('N')}, .enabled = outline.problems.empty()};
  const Rect button = strip.take_right(ui.button_width(tr("Begin a study"), begin), 12);
  if (ui.button("begin_study", button.middle(button.width, 38), tr("Begin a study"), begin)) {
    state.asks_for_folder = state.dialog_is_new = true;
    state.folder_problem.clear();
    state.new_folder = model.proposed_folder;
  }
  ui.text(strip.take_left(ui.text_width("jnd", Font::kLarge) + 1, 18), "jnd",
          {.font = Font::kLarge});
  const std::string title =
      outline.title.empty() ? outline.file.filename().string() : outline.title;
  const float width = std::min(ui.text_width(title, Font::kBody) + 2, strip.width - 120);
  ui.text(strip.take_left(width, 18), title, {.any_length = true});
  ui.chip(strip.x, place.y + (place.height - 26) / 2, tr("study file"), Colour::kBlue);
  return chosen ? StudyTab::kStart : StudyTab::kNone;
}

void draw_stage(Ui& ui, Rect& inside, const OutlineStage& stage) {
  constexpr float kIndent = 24;
  constexpr float kDetail = 22;
  const bool is_arm = stage.is_arm;
  const auto details =
      static_cast<float>(stage.details.size() + (stage.only_for.empty() ? 0 : 1));
  const float first = is_arm ? 34.0f : 28.0f;
  const float second = is_arm ? 0.0f : 24.0f;
  Rect row = inside.take_top(first + second + details * kDetail + (is_arm ? 0.0f : 16.0f));
  ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  const float indent = kIndent * static_cast<float>(stage.depth);
  for (int level = 1; level <= stage.depth; ++level) {
    const float x = row.x + kIndent * (static_cast<float>(level) - 0.5f);
    ui.line(x, row.y, x, row.bottom(), Colour::kLine);
  }
  row.take_left(indent);
  if (!is_arm) row.take_top(8);
  Rect head = row.take_top(first);
  const std::string length = duration_words(stage.duration_s);
  const float of_length = std::max(90.0f, ui.text_width(length, Font::kSmall) + 2);
  ui.text(head.take_right(of_length, 12), length,
          {.font = Font::kSmall, .colour = Colour::kSoft, .align = Align::kRight});
  if (stage.line > 0) {
    ui.text(head.take_right(60, 8), tr("line {}", stage.line),
            {.font = Font::kTiny, .colour = Colour::kSoft, .align = Align::kRight});
  }
  ui.text(head, stage.title,
          {.font = is_arm ? Font::kSmallStrong : Font::kStrong, .any_length = true});
  if (is_arm) return;
  ui.text(row.take_top(second), stage.kind + (stage.what.empty() ? "" : " · " + stage.what),
          {.colour = Colour::kSoft, .any_length = true});
  const TextStyle small{.font = Font::kSmall, .any_length = true};
  for (const std::string& detail : stage.details) ui.text(row.take_top(kDetail), detail, small);
  if (!stage.only_for.empty()) {
    ui.text(row.take_top(kDetail), stage.only_for,
            {.font = Font::kSmall, .colour = Colour::kAmber, .any_length = true});
  }
}

void draw_outline(Ui& ui, const Rect& place, const StudyOutline& outline, StudyViewState& state,
                  StudyViewResult& result) {
  if (!outline.problems.empty()) return draw_study_problems(ui, place, outline, state, result);
  Rect inside = draw_card(ui, place, tr("Stages"));
  if (!outline.doubts.empty()) {
    draw_study_doubts(ui, inside.take_top(std::min(180.0f, inside.height * 0.35f), 10),
                      outline);
  }
  inside = ui.begin_scroll("outline", inside, state.outline_height);
  const float top = inside.y;
  for (const OutlineStage& stage : outline.stages) draw_stage(ui, inside, stage);
  state.outline_height = inside.y - top;
  ui.end_scroll();
}

void draw_wrapped_fact(Ui& ui, Rect& inside, const std::string& name,
                       const std::string& value) {
  if (value.empty()) return;
  const TextStyle style{.font = Font::kSmall, .wrap = true};
  const float name_width = std::clamp(ui.text_width(name, Font::kSmall) + 10, 104.0f, 140.0f);
  const float height = std::max(22.0f, ui.text_height(inside.width - name_width, value, style));
  Rect row = inside.take_top(height, 4);
  Rect name_place = row.take_left(name_width);
  ui.text(name_place.take_top(ui.line_height(Font::kSmall)), name,
          {.font = Font::kSmall, .colour = Colour::kSoft});
  ui.text(row, value, style);
}

std::string length_words(const StudyOutline& outline) {
  const std::string longest = duration_words(outline.longest_s);
  const std::string shortest = duration_words(outline.shortest_s);
  return shortest == longest ? tr("about {}", longest) : tr("{} to {}", shortest, longest);
}

void draw_facts(Ui& ui, Rect& inside, const StudyOutline& outline) {
  ui.heading(inside.take_top(18, 8), tr("Study"));
  if (!outline.problems.empty()) {
    ui.text(inside.take_top(24, 16), tr("Not known until the file is sound."),
            {.colour = Colour::kSoft});
    return;
  }
  draw_wrapped_fact(
      ui, inside, tr("Length"),
      length_words(outline) + ", " + trn("{} trial", "{} trials", outline.num_trials));
  draw_wrapped_fact(ui, inside, tr("Blinding"), outline.blinding);
  draw_wrapped_fact(ui, inside, tr("Device"), outline.device);
  draw_wrapped_fact(ui, inside, tr("Sound"), outline.sound);
  draw_wrapped_fact(ui, inside, tr("Languages"), outline.languages);
  draw_wrapped_fact(ui, inside, tr("Authors"), outline.authors);
  draw_wrapped_fact(ui, inside, tr("About"), outline.description);
  inside.take_top(14);
}

void draw_orders(Ui& ui, Rect& inside, const StudyViewModel& model, StudyViewState& state,
                 StudyViewResult& result) {
  const std::string heading = tr("Orders of the next {}", state.num_participants);
  ButtonStyle more{.key = {Key::kPlus},
                   .enabled = state.num_participants < kMostParticipants,
                   .repeats = true};
  ButtonStyle fewer{
      .key = {Key::kMinus}, .enabled = state.num_participants > 1, .repeats = true};
  const auto has_room = [&] {
    return ui.button_width(tr("More"), more) + 8 + ui.button_width(tr("Fewer"), fewer) + 12 +
               ui.text_width(heading, Font::kSmallStrong) <=
           inside.width;
  };
  if (!has_room()) more.hides_key = fewer.hides_key = true;
  const bool is_above = !has_room();
  if (is_above) ui.heading(inside.take_top(18, 6), heading);
  Rect head = inside.take_top(38, 8);
  const int before = state.num_participants;
  if (ui.button("more_participants", head.take_right(ui.button_width(tr("More"), more), 8),
                tr("More"), more)) {
    ++state.num_participants;
  }
  if (ui.button("fewer_participants", head.take_right(ui.button_width(tr("Fewer"), fewer), 12),
                tr("Fewer"), fewer)) {
    --state.num_participants;
  }
  result.orders_changed = state.num_participants != before;
  if (!is_above) ui.heading(head, heading);
  if (!model.orders_problem.empty()) {
    const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
    ui.text(inside.take_top(ui.text_height(inside.width, model.orders_problem, soft)),
            model.orders_problem, soft);
    return;
  }
  for (const PlannedOrder& order : model.orders) {
    Rect line = inside.take_top(30);
    const std::string length = duration_words(order.duration_s);
    const float of_length = std::max(80.0f, ui.text_width(length, Font::kSmall) + 2);
    ui.text(line.take_right(of_length, 8), length,
            {.font = Font::kSmall, .colour = Colour::kSoft, .align = Align::kRight});
    const float name = ui.text_width(order.participant, Font::kStrong) + 2;
    ui.text(line.take_left(name, 12), order.participant, {.font = Font::kStrong});
    ui.text(line, order.cells,
            {.font = Font::kSmall, .colour = Colour::kBlue, .any_length = true});
    const TextStyle small{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
    for (const std::string& block : order.blocks) {
      const float height = ui.text_height(inside.width, block, small);
      ui.text(inside.take_top(height, 4), block, small);
    }
    const Rect gap = inside.take_top(8);
    ui.line(gap.x, gap.bottom(), gap.right(), gap.bottom(), Colour::kLine);
  }
}

std::string reload_words(const StudyViewModel& model) {
  if (model.num_reloads == 0) return tr("Read once; read again whenever the file is saved");
  const auto seconds = std::llround(std::max(0.0, model.since_reload_s));
  return tr("Read again {} ago", duration_words(static_cast<double>(seconds)));
}

void draw_folder_dialog(Ui& ui, StudyViewState& state, StudyViewResult& result) {
  Rect inside = ui.begin_dialog("folder_dialog", 680, 270);
  ui.text(inside.take_top(34, 4), tr("Begin a study with this file"), {.font = Font::kLarge});
  ui.text(inside.take_top(26, 12), tr("Its sessions go into a folder of their own."),
          {.colour = Colour::kSoft});
  const bool entered =
      ui.text_field("new_folder", inside.take_top(46, 10), state.new_folder,
                    tr("path of a folder that does not exist yet"), state.dialog_is_new);
  const Rect buttons = inside.take_bottom(48, 8);
  const TextStyle style{.font = Font::kSmall, .colour = Colour::kRed, .wrap = true};
  ui.text(inside, state.folder_problem, style);
  const DialogChoice choice =
      draw_dialog_buttons(ui, buttons, tr("Begin"), !state.new_folder.empty(), entered);
  ui.end_dialog();
  state.dialog_is_new = entered && !choice.done;
  result.begin = choice.done;
  if (choice.done || choice.cancelled) state.asks_for_folder = false;
}

}  // namespace

StudyTabLook tab_of_study() { return {StudyTab::kStudy, "tab_study", tr_later("Study"), '3'}; }

StudyViewResult draw_study_view(Ui& ui, const StudyViewModel& model, StudyViewState& state) {
  StudyViewResult result;
  Rect rest = ui.screen();
  const Rect header = rest.take_top(kHeaderHeight);
  result.tab = model.study != nullptr
                   ? draw_study_header(ui, header, *model.study, StudyTab::kStudy).chosen
                   : draw_file_header(ui, header, model, state);
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  const Rect right = rest.take_right(std::clamp(rest.width * 0.42f, 400.0f, 680.0f), kGap);
  draw_outline(ui, rest, model.outline, state, result);
  ui.card(right);
  Rect inside = ui.begin_scroll("orders", right.inset(kPadding), state.orders_height);
  const float top = inside.y;
  draw_facts(ui, inside, model.outline);
  if (model.outline.problems.empty()) draw_orders(ui, inside, model, state, result);
  state.orders_height = inside.y - top;
  ui.end_scroll();
  draw_study_footer(ui, footer, reload_words(model), model.outline.file.string(),
                    /*is_path=*/true);
  if (state.asks_for_folder) draw_folder_dialog(ui, state, result);
  return result;
}

}  // namespace jnd::app::gui
