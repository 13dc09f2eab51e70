#include "app/gui/views/start_dialogs.h"

#include <algorithm>
#include <cstdlib>

#include "app/gui/views/layout.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"
#include "app/operator/study_words.h"

namespace jnd::app::gui {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDialogKeys = 9;

Chord key_of(std::size_t place) {
  if (place >= kMostDialogKeys) return {};
  return {.key = letter(static_cast<char>('1' + place)), .control = true};
}

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

/// One of the shipped studies, or an entry of a folder.
bool draw_choice(Ui& ui, const std::string& name, const Rect& place, const std::string& label,
                 const std::string& kind, Chord key, bool selected) {
  if (selected) ui.fill(place, Colour::kBlueSoft, 8);
  const bool chosen = ui.row(name, place, label, key);
  Rect words = place;
  words.take_left(12);
  words.take_right(12);
  if (key.key != Key::kNone) {
    const Rect cap = words.take_right(ui.key_cap_width(key), 12);
    ui.key_cap(cap.x, cap.y + (cap.height - 20) / 2, key);
  }
  const float width = ui.text_width(kind, Font::kSmall) + 2;
  if (!kind.empty()) {
    ui.text(words.take_right(width, 12), kind, {.font = Font::kSmall, .colour = Colour::kSoft});
  }
  ui.text(words, label,
          {.font = selected ? Font::kStrong : Font::kBody,
           .colour = selected ? Colour::kBlue : Colour::kInk});
  return chosen;
}

/// As a shell would take it: ~ is the home folder.
fs::path typed_path(const std::string& typed) {
  const char* home = std::getenv("HOME");
  if (home == nullptr || !(typed == "~" || typed.starts_with("~/"))) return typed;
  return fs::path(home) / fs::path(typed.substr(std::min<std::size_t>(2, typed.size())));
}

std::string kind_of(FolderEntry::Kind kind) {
  switch (kind) {
    case FolderEntry::Kind::kFolder:
      return tr("folder");
    case FolderEntry::Kind::kStudyFolder:
      return tr("study");
    case FolderEntry::Kind::kBackup:
      return tr("backup, to be read only");
    case FolderEntry::Kind::kStudyFile:
      return tr("study file");
  }
  return "";
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
  state.open_path.clear();
  state.listed.clear();
  if (state.browsing.empty()) {
    const fs::path studies = default_study_folder("study").parent_path();
    std::error_code ignored;
    state.browsing = fs::is_directory(studies, ignored) ? studies : fs::current_path(ignored);
  }
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
                    name_words(model.shipped[i], /*as_title=*/true), "", key_of(i), selected)) {
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

void draw_open_dialog(
    Ui& ui,
    const std::function<std::vector<FolderEntry>(const std::filesystem::path&)>& entries_of,
    StartViewState& state, StartViewResult& result) {
  Rect inside = ui.begin_dialog("open_dialog", 760, std::min(640.0f, ui.screen().height - 60));
  ui.text(inside.take_top(34, 8), tr("Open a study"), {.font = Font::kLarge});
  const bool entered = ui.text_field("open_path", inside.take_top(46, 14), state.open_path,
                                     tr("path of a study folder or file"), state.dialog_is_new);
  const Rect buttons = inside.take_bottom(48, 12);
  draw_problem(ui, inside, state.problem);
  Rect where = inside.take_top(40, 6);
  const ButtonStyle up{.key = {.key = Key::kUp, .control = true},
                       .enabled = state.browsing.has_relative_path()};
  if (ui.button("folder_up", where.take_right(ui.button_width(tr("Go up"), up), 12),
                tr("Go up"), up)) {
    state.browsing = state.browsing.parent_path();
  }
  ui.text(where, state.browsing.string(), {.font = Font::kMono, .colour = Colour::kSoft});
  constexpr float kRow = 40;
  if (state.listed != state.browsing) {
    state.entries = entries_of(state.browsing);
    state.listed = state.browsing;
  }
  const std::vector<FolderEntry>& entries = state.entries;
  if (entries.empty()) draw_notice(ui, inside, tr("There is no study and no folder here."));
  const auto content = kRow * static_cast<float>(entries.size());
  Rect rows = ui.begin_scroll("entries", inside, content);
  std::optional<fs::path> chosen;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const FolderEntry& entry = entries[i];
    const std::string label = entry.path.filename().string();
    if (!draw_choice(ui, "entry_" + label, rows.take_top(kRow), label, kind_of(entry.kind),
                     key_of(i), false)) {
      continue;
    }
    if (entry.kind == FolderEntry::Kind::kFolder) {
      state.browsing = entry.path;
    } else {
      chosen = entry.path;
    }
  }
  ui.end_scroll();
  const DialogChoice choice =
      draw_dialog_buttons(ui, buttons, tr("Open"), !state.open_path.empty(), entered);
  ui.end_dialog();
  state.dialog_is_new = entered && !choice.done;
  if (choice.done) chosen = typed_path(state.open_path);
  if (chosen) result.open = chosen;
  if (chosen || choice.cancelled) state.dialog = StartViewState::Dialog::kNone;
}

}  // namespace jnd::app::gui
