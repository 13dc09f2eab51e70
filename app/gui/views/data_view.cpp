#include "app/gui/views/data_view.h"

#include <algorithm>
#include <functional>
#include <vector>

#include "app/gui/views/data_parts.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/stack.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

using DataPage = DataViewState::Page;
using DataDialog = DataViewState::Dialog;

struct DataPageLook {
  DataPage page;
  const char *name, *label;
};

void draw_data_header(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                      DataViewResult& result) {
  ui.fill(place, Colour::kCard);
  ui.line(place.x, place.bottom(), place.right(), place.bottom(), Colour::kLine);
  Rect strip = place;
  strip.take_left(20);
  strip.take_right(20);
  const bool may_save = data.results && !data.results->groups.empty();
  struct Button {
    const char *name, *label;
    ButtonStyle style;
    float height;
    std::function<void()> act;
  };
  std::vector<Button> buttons;
  if (!data.file.empty()) {
    buttons.push_back(
        {"open_another", tr("Open another file"), {.key = {letter('O'), true}}, 38, [&] {
           open_data_dialog(state, DataDialog::kFile);
         }});
  }
  const auto add_save = [&](const char* name, const char* label, char letter_of,
                            DataDialog dialog, const char* ending) {
    buttons.push_back({name,
                       label,
                       {.key = {letter(letter_of), true}, .enabled = !data.is_saving},
                       38,
                       [&data, &state, dialog, ending] {
                         open_data_dialog(state, dialog,
                                          free_file_beside(data.file, ending).string());
                       }});
  };
  if (may_save) {
    add_save("save_picture", tr("Save picture"), 'S', DataDialog::kPicture, ".svg");
    add_save("save_table", tr("Save table"), 'E', DataDialog::kTable, ".csv");
  }
  buttons.push_back(
      {"tab_start", tr("Start"), {.tone = Tone::kQuiet, .key = {letter('0'), true}}, 36, [&] {
         result.tab = StudyTab::kStart;
       }});
  // Keeps some room for the file's name. If room is short, keys are left out before words are.
  constexpr float kLeastName = 140, kBetween = 10;
  const float room = strip.width - ui.text_width("jnd", Font::kLarge) - 18 - kLeastName;
  float wanted = 0;
  for (const bool has_keys : {true, false}) {
    wanted = 0;
    for (Button& button : buttons) {
      button.style.hides_key = !has_keys;
      wanted += ui.button_width(button.label, button.style) + kBetween;
    }
    if (wanted <= room) break;
  }
  const float shrink = std::min(1.0f, room / wanted);
  for (const Button& button : buttons) {
    const Rect its =
        strip.take_right(shrink * ui.button_width(button.label, button.style), kBetween);
    if (ui.button(button.name, its.middle(its.width, button.height), button.label,
                  button.style)) {
      button.act();
    }
  }
  ui.text(strip.take_left(ui.text_width("jnd", Font::kLarge) + 1, 18), "jnd",
          {.font = Font::kLarge});
  ui.text(strip, data.file.empty() ? tr("Your own data") : data.file.filename().string(),
          {.any_length = !data.file.empty()});
}

void draw_without_file(Ui& ui, const Rect& place, const DataView& data, DataViewState& state) {
  ui.card(place);
  const bool is_wrong = !data.problem.empty();
  const float width = std::min(620.0f, place.width - 64);
  Stack stack(ui);
  stack.add_text(is_wrong ? tr("This file cannot be read") : tr("Open a table of answers"),
                 Font::kTitle, Colour::kInk, width, 14);
  if (is_wrong) stack.add_text(data.problem, Font::kBody, Colour::kRed, width, 18);
  stack.add_text(
      tr("Each row is one trial, or a count of trials: the intensity, and what was answered. "
         "CSV, TSV and jsPsych's JSON are read as they are. Choose a file, or drop it on this "
         "window; it is read and never changed."),
      Font::kBody, Colour::kSoft, width, 28);
  const ButtonStyle open{.tone = Tone::kPrimary, .key = {Key::kEnter}};
  const char* label = is_wrong ? tr("Choose another file") : tr("Choose a file");
  stack.add(52, 0, [&](const Rect& row) {
    const float button = ui.button_width(label, open) + 24;
    if (ui.button("open_file", row.middle(button, 52), label, open)) {
      open_data_dialog(state, DataDialog::kFile);
    }
  });
  stack.draw(place.inset(kPadding));
}

/// Draws the tabs of the pages.
void draw_data_strip(Ui& ui, Rect strip, const DataView& data, DataViewState& state) {
  std::vector<DataPageLook> pages = {{DataPage::kTable, "page_table", tr("Table")},
                                     {DataPage::kCurves, "page_curves", tr("Curves")}};
  // The page stays while another curve is being fitted.
  if (data.can_compare || (data.is_computing && state.page == DataPage::kComparison)) {
    pages.push_back({DataPage::kComparison, "page_comparison", tr("Comparison")});
  }
  const bool is_asking = data.results && data.results->suspected_alternatives;
  if (!data.command.empty() && !is_asking) {
    pages.push_back({DataPage::kCommand, "page_command", tr("Command")});
  }
  if (std::ranges::find(pages, state.page, &DataPageLook::page) == pages.end()) {
    state.page = DataPage::kCurves;
  }
  const auto style_of = [&state](const DataPageLook& look) {
    const auto digit = static_cast<char>('1' + static_cast<int>(look.page));
    return ButtonStyle{.key = {letter(digit)}, .selected = look.page == state.page};
  };
  float wanted = 0;
  for (const DataPageLook& look : pages) {
    wanted += ui.button_width(look.label, style_of(look)) + 8;
  }
  const float shrink = std::min(1.0f, strip.width / std::max(1.0f, wanted));
  for (const DataPageLook& look : pages) {
    const ButtonStyle style = style_of(look);
    const float width = shrink * (ui.button_width(look.label, style) + 8) - 8;
    if (ui.button(look.name, strip.take_left(width, 8), look.label, style)) {
      state.page = look.page;
      state.is_copied = false;
    }
  }
}

void draw_data_page(Ui& ui, const Rect& place, const DataView& data, DataViewState& state,
                    DataViewResult& result) {
  switch (state.page) {
    case DataPage::kTable:
      return draw_data_table(ui, place, data, state);
    case DataPage::kCurves:
      return draw_data_curves(ui, place, data, state, result);
    case DataPage::kComparison:
      return draw_data_comparison(ui, place, data, state, result);
    case DataPage::kCommand:
      return draw_data_command(ui, place, data, state);
  }
}

std::string footer_words(const DataView& data, const DataViewState& state) {
  if (state.is_copied) return tr("The command is on the clipboard.");
  if (data.is_saving) return tr("Saving …");
  if (!data.outcome.sentence.empty()) return data.outcome.sentence;
  if (data.is_reading) return tr("Reading {} …", data.file.filename().string());
  if (!data.preview) return "";
  return trn("{} row", "{} rows", data.preview->num_rows) + " · " +
         trn("{} column", "{} columns", std::ssize(data.preview->columns)) + " · " +
         data.file.parent_path().string();
}

}  // namespace

void open_data_dialog(DataViewState& state, DataDialog dialog, const std::string& typed) {
  state.dialog = dialog;
  state.dialog_is_new = true;
  state.typed = typed;
  state.num_rewrites = 0;
  state.problem.clear();
  state.is_copied = false;
  if (dialog == DataDialog::kFile) begin_file_dialog(state.opening, {});
}

DataViewResult draw_data_view(Ui& ui, const DataView& data, const EntriesOf& entries_of,
                              DataViewState& state) {
  DataViewResult result;
  Rect rest = ui.screen();
  draw_data_header(ui, rest.take_top(kHeaderHeight), data, state, result);
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  if (data.preview) {
    const float settings = std::clamp(rest.width * 0.26f, 320.0f, 420.0f);
    draw_data_settings(ui, rest.take_left(settings, kGap), data, state, result);
    draw_data_strip(ui, rest.take_top(40, kGap), data, state);
    draw_data_page(ui, rest, data, state, result);
  } else if (data.is_reading) {
    ui.card(rest);
    draw_notice(ui, rest, tr("Reading {} …", data.file.filename().string()));
  } else {
    draw_without_file(ui, rest, data, state);
  }
  draw_study_footer(ui, footer, footer_words(data, state), "");
  if (state.dialog != DataDialog::kNone) draw_data_dialog(ui, data, entries_of, state, result);
  return result;
}

}  // namespace jnd::app::gui
