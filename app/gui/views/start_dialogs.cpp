#include "app/gui/views/start_dialogs.h"

#include <algorithm>

#include "app/gui/views/layout.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_words.h"

namespace jnd::app::gui {
namespace {

namespace fs = std::filesystem;

void begin(StartViewState& state, StartViewState::Dialog dialog) {
  state.dialog = dialog;
  state.dialog_is_new = true;
  state.problem.clear();
}

/// Without its file name's ending; "" for nothing typed.
std::string name_of(const StartModel& model, const StartViewState& state) {
  if (!state.study_file.empty()) return fs::path(state.study_file).stem().string();
  return state.chosen_shipped < model.shipped.size() ? model.shipped[state.chosen_shipped] : "";
}

/// A place for the study, unless one was typed.
void propose_folder(const StartModel& model, StartViewState& state) {
  if (state.new_folder != state.proposed_folder) return;
  const std::string name = name_of(model, state);
  if (name.empty()) return;
  state.new_folder = state.proposed_folder = default_study_folder(name).string();
}

void draw_problem(Ui& ui, Rect& inside, const std::string& problem) {
  if (problem.empty()) return;
  const TextStyle style{.font = Font::kSmall, .colour = Colour::kRed, .wrap = true};
  ui.text(inside.take_bottom(ui.text_height(inside.width, problem, style), 8), problem, style);
}

}  // namespace

void open_new_dialog(const StartModel& model, StartViewState& state) {
  begin(state, StartViewState::Dialog::kNew);
  state.study_file.clear();
  state.new_folder = state.proposed_folder = "";
  propose_folder(model, state);
}

void open_open_dialog(StartViewState& state) {
  begin(state, StartViewState::Dialog::kOpen);
  begin_file_dialog(state.opening, default_study_folder("study").parent_path());
}

void draw_new_dialog(Ui& ui, const StartModel& model, StartViewState& state,
                     StartViewResult& result) {
  constexpr float kRow = 40;
  const float list = std::min(5.0f, static_cast<float>(model.shipped.size())) * kRow;
  Rect inside = ui.begin_dialog("new_dialog", 680, 396 + list);
  ui.text(inside.take_top(34, 4), tr("New study"), {.font = Font::kLarge});
  ui.text(inside.take_top(26, 10),
          tr("Choose a study to begin, or write the path of your own."),
          {.colour = Colour::kSoft});
  Rect rows = ui.begin_scroll("shipped", inside.take_top(list, 14),
                              static_cast<float>(model.shipped.size()) * kRow);
  for (std::size_t i = 0; i < model.shipped.size(); ++i) {
    const bool selected = state.study_file.empty() && i == state.chosen_shipped;
    if (draw_choice(ui, "shipped_" + model.shipped[i], rows.take_top(kRow),
                    name_words(model.shipped[i], /*as_title=*/true), "", key_of_choice(i),
                    selected)) {
      state.chosen_shipped = i;
      state.study_file.clear();
    }
  }
  ui.end_scroll();
  ui.heading(inside.take_top(18, 6), tr("Or a study file"));
  bool entered = ui.text_field("study_file", inside.take_top(46, 14), state.study_file,
                               tr("path of a study file"), state.dialog_is_new);
  ui.heading(inside.take_top(18, 6), tr("Folder of the new study"));
  propose_folder(model, state);
  entered |= ui.text_field("new_folder", inside.take_top(46, 10), state.new_folder,
                           tr("path of a folder that does not exist yet"));
  const bool ready = !name_of(model, state).empty() && !state.new_folder.empty();
  const Rect buttons = inside.take_bottom(48, 8);
  draw_problem(ui, inside, state.problem);
  const DialogChoice choice = draw_dialog_buttons(ui, buttons, tr("Begin"), ready, entered);
  ui.end_dialog();
  // Enter ends a field; where something is missing yet, it goes on.
  state.dialog_is_new = entered && !choice.done;
  if (choice.done) {
    result.create = {state.study_file.empty() ? model.shipped[state.chosen_shipped]
                                              : typed_path(state.study_file).string(),
                     typed_path(state.new_folder)};
  }
  if (choice.done || choice.cancelled) state.dialog = StartViewState::Dialog::kNone;
}

void draw_open_dialog(Ui& ui, const EntriesOf& entries_of, StartViewState& state,
                      StartViewResult& result) {
  const FileDialogResult found =
      draw_file_dialog(ui,
                       {.title = tr("Open a study"),
                        .hint = tr("path of a study folder or file"),
                        .nothing = tr("There is no study and no folder here.")},
                       entries_of, state.opening);
  if (found.chosen) result.open = found.chosen;
  if (found.is_closed) state.dialog = StartViewState::Dialog::kNone;
}

}  // namespace jnd::app::gui
