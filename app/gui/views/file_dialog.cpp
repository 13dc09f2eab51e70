#include "app/gui/views/file_dialog.h"

#include <algorithm>
#include <cstdlib>

#include "app/gui/views/layout.h"
#include "app/gui/views/list_keys.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

namespace fs = std::filesystem;

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
    case FolderEntry::Kind::kTable:
      return tr("table");
  }
  return "";
}

}  // namespace

fs::path typed_path(const std::string& typed) {
  const char* home = std::getenv("HOME");
  if (home == nullptr || !(typed == "~" || typed.starts_with("~/"))) return typed;
  return fs::path(home) / fs::path(typed.substr(std::min<std::size_t>(2, typed.size())));
}

void begin_file_dialog(FileDialogState& state, const fs::path& start) {
  state.is_new = true;
  state.open_path.clear();
  state.listed.clear();
  state.chosen.reset();
  state.problem.clear();
  if (!state.browsing.empty()) return;
  std::error_code ignored;
  state.browsing = fs::is_directory(start, ignored) ? start : fs::current_path(ignored);
}

void go_on_with_file_dialog(FileDialogState& state, const std::string& problem) {
  state.is_new = true;
  state.chosen.reset();
  state.problem = problem;
}

FileDialogResult draw_file_dialog(Ui& ui, const FileDialogWords& words,
                                  const EntriesOf& entries_of, FileDialogState& state) {
  FileDialogResult result;
  Rect inside = ui.begin_dialog("open_dialog", 760, std::min(640.0f, ui.screen().height - 60));
  ui.text(inside.take_top(34, 8), words.title, {.font = Font::kLarge});
  const std::string before = state.open_path;
  const bool entered = ui.text_field("open_path", inside.take_top(46, 14), state.open_path,
                                     words.hint, state.is_new);
  if (state.open_path != before) {
    state.problem.clear();
    state.chosen.reset();
  }
  const Rect buttons = inside.take_bottom(48, 12);
  if (!state.problem.empty()) {
    const TextStyle style{.font = Font::kSmall, .colour = Colour::kRed, .wrap = true};
    const float height = std::min(120.0f, ui.text_height(inside.width, state.problem, style));
    ui.text(inside.take_top(height, 12), state.problem, style);
  }
  Rect where = inside.take_top(40, 6);
  const ButtonStyle up{.key = {.key = Key::kUp, .control = true},
                       .enabled = state.browsing.has_relative_path()};
  if (ui.button("folder_up", where.take_right(ui.button_width(tr("Go up"), up), 12),
                tr("Go up"), up)) {
    state.browsing = state.browsing.parent_path();
  }
  constexpr float kRow = 40;
  if (state.listed != state.browsing) {
    state.entries = entries_of(state.browsing);
    state.listed = state.browsing;
    state.chosen.reset();
  }
  const std::vector<FolderEntry>& entries = state.entries;
  if (!entries.empty()) draw_list_keys(ui, where);
  ui.text(where, state.browsing.string(),
          {.font = Font::kMono, .colour = Colour::kSoft, .any_length = true});
  if (entries.empty()) draw_notice(ui, inside, words.nothing);
  if (move_in_list(ui, entries.size(), state.chosen)) {
    ui.scroll_into_view("entries", kRow * static_cast<float>(*state.chosen), kRow);
  }
  const auto content = kRow * static_cast<float>(entries.size());
  Rect rows = ui.begin_scroll("entries", inside, content);
  std::optional<std::size_t> taken;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string label = entries[i].path.filename().string();
    if (draw_choice(ui, "entry_" + label, rows.take_top(kRow), label, kind_of(entries[i].kind),
                    key_of_choice(i), state.chosen == i, /*any_length=*/true)) {
      taken = i;
    }
  }
  ui.end_scroll();
  const bool is_ready = state.chosen || !state.open_path.empty();
  DialogChoice choice = draw_dialog_buttons(ui, buttons, tr("Open"), is_ready, entered);
  ui.end_dialog();
  // Enter opens the entry that the arrow keys have reached, rather than what is typed.
  if (choice.done && state.chosen) {
    taken = state.chosen;
    choice.done = false;
  }
  if (taken) {
    state.problem.clear();
    const FolderEntry& entry = entries[*taken];
    if (entry.kind == FolderEntry::Kind::kFolder) {
      state.browsing = entry.path;
    } else {
      result.chosen = entry.path;
    }
  }
  state.is_new = entered && !choice.done;
  if (choice.done) result.chosen = typed_path(state.open_path);
  result.is_closed = result.chosen.has_value() || choice.cancelled;
  return result;
}

}  // namespace jnd::app::gui
