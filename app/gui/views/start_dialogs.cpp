#include "app/gui/views/start_dialogs.h"

#include <algorithm>

#include "app/gui/views/fitted_text.h"
#include "app/gui/views/layout.h"
#include "app/gui/views/list_keys.h"
#include "app/language/words.h"
#include "app/operator/study_folder.h"

namespace jnd::app::gui {
namespace {

namespace fs = std::filesystem;

constexpr float kCardOfStudy = 110;
constexpr float kBetweenStudies = 10;

void begin(StartViewState& state, StartViewState::Dialog dialog) {
  state.dialog = dialog;
  state.dialog_is_new = true;
  state.problem.clear();
}

std::size_t num_cards(const StartModel& model) {
  return model.drafts.size() + model.shipped.size();
}

/// The card at this place, counting drafts first; nullptr if there is none.
const StudyCard* card_at(const StartModel& model, std::size_t place) {
  if (place < model.drafts.size()) return &model.drafts[place];
  place -= model.drafts.size();
  return place < model.shipped.size() ? &model.shipped[place] : nullptr;
}

/// The file that the new study begins with: a path, or the name of a shipped study; "" for
/// none.
std::string study_of(const StartModel& model, const StartViewState& state) {
  if (!state.study_file.empty()) return typed_path(state.study_file).string();
  const StudyCard* card = card_at(model, state.chosen_card);
  return card == nullptr ? "" : card->name;
}

/// Proposes a folder for the study, unless the person typed one.
void propose_folder(const StartModel& model, StartViewState& state) {
  if (state.new_folder != state.proposed_folder) return;
  const std::string name = fs::path(study_of(model, state)).stem().string();
  if (name.empty()) return;
  state.new_folder = state.proposed_folder = default_study_folder(name).string();
}

void draw_problem(Ui& ui, Rect& inside, const std::string& problem) {
  if (problem.empty()) return;
  const TextStyle style{.font = Font::kSmall, .colour = Colour::kRed, .wrap = true};
  const float height = std::min(84.0f, ui.text_height(inside.width, problem, style));
  ui.text(inside.take_bottom(height, 8), problem, style);
}

/// Draws a card that says what a study is for, how long it takes, and which publication it
/// follows.
bool draw_card_of_study(Ui& ui, const std::string& name, const Rect& place,
                        const StudyCard& card, const Chord& key, bool is_chosen) {
  if (is_chosen) ui.fill(place, Colour::kBlueSoft, 9);
  ui.outline(place, is_chosen ? Colour::kBlue : Colour::kLine, 9, is_chosen ? 1.5f : 1.0f);
  const bool taken = ui.row(name, place, card.title, key);
  Rect inside = place.inset(12);
  Rect head = inside.take_top(24, 2);
  if (key.key != Key::kNone) {
    const Rect cap = head.take_right(ui.key_cap_width(key), 12);
    ui.key_cap(cap.x, cap.y + (cap.height - Ui::kKeyCapHeight) / 2, key);
  }
  const std::string length =
      card.num_problems > 0
          ? trn("{} problem in the file", "{} problems in the file", card.num_problems)
          : card.length;
  const float width = ui.text_width(length, Font::kSmallStrong) + 2;
  ui.text(head.take_right(std::min(width, head.width * 0.5f), 16), length,
          {.font = Font::kSmallStrong,
           .colour = card.num_problems > 0 ? Colour::kRed : Colour::kBlue,
           .align = Align::kRight});
  ui.text(head, card.title, {.font = Font::kStrong, .any_length = true});
  const TextStyle purpose{.font = Font::kSmall, .wrap = true};
  const std::string words =
      card.num_problems > 0
          ? std::string(tr("It opens with every problem at its line, to be mended."))
          : card.purpose;
  const Rect two_lines = inside.take_top(2 * ui.line_height(Font::kSmall), 2);
  draw_fitted(ui, two_lines, words, purpose);
  ui.text(inside, card.is_draft ? card.file.string() : card.citation,
          {.font = Font::kTiny, .colour = Colour::kSoft, .any_length = true});
  return taken;
}

void draw_cards(Ui& ui, const Rect& place, const StartModel& model, StartViewState& state) {
  if (num_cards(model) == 0) {
    draw_notice(ui, place, tr("Looking for studies … A file of your own can be named below."));
    return;
  }
  std::optional<std::size_t> chosen = state.chosen_card;
  const float step = kCardOfStudy + kBetweenStudies;
  if (move_in_list(ui, num_cards(model), chosen)) {
    state.chosen_card = *chosen;
    state.study_file.clear();
    ui.scroll_into_view("cards", step * static_cast<float>(*chosen), kCardOfStudy);
  }
  Rect rows = ui.begin_scroll("cards", place,
                              step * static_cast<float>(num_cards(model)) - kBetweenStudies);
  for (std::size_t i = 0; i < num_cards(model); ++i) {
    const Rect row = rows.take_top(kCardOfStudy, kBetweenStudies);
    const bool is_chosen = state.study_file.empty() && i == state.chosen_card;
    const StudyCard& card = *card_at(model, i);
    const std::string name =
        card.is_draft ? "draft_" + std::to_string(i + 1) : "shipped_" + card.name;
    if (draw_card_of_study(ui, name, row.inset(1), card, key_of_choice(i), is_chosen)) {
      state.chosen_card = i;
      state.study_file.clear();
    }
  }
  ui.end_scroll();
}

}  // namespace

void open_new_dialog(const StartModel& model, StartViewState& state) {
  begin(state, StartViewState::Dialog::kNew);
  state.study_file.clear();
  state.new_folder = state.proposed_folder = "";
  state.chosen_card = 0;
  propose_folder(model, state);
}

void open_open_dialog(StartViewState& state) {
  begin(state, StartViewState::Dialog::kOpen);
  begin_file_dialog(state.opening, default_study_folder("study").parent_path());
}

void draw_new_dialog(Ui& ui, const StartModel& model, StartViewState& state,
                     StartViewResult& result) {
  Rect inside = ui.begin_dialog("new_dialog", 900, std::min(900.0f, ui.screen().height - 40));
  Rect title = inside.take_top(34, 4);
  draw_list_keys(ui, title);
  ui.text(title, tr("New study"), {.font = Font::kLarge});
  ui.text(inside.take_top(26, 10), tr("Choose a study to begin with, or a file of your own."),
          {.colour = Colour::kSoft});
  const Rect buttons = inside.take_bottom(48, 12);
  draw_problem(ui, inside, state.problem);
  Rect below = inside.take_bottom(18 + 6 + 46 + 14 + 18 + 6 + 46, 14);
  draw_cards(ui, inside, model, state);
  ui.heading(below.take_top(18, 6), tr("Or a study file"));
  Rect file = below.take_top(46, 14);
  const ButtonStyle browse{.key = {letter('B'), true}};
  const Rect at_right = file.take_right(ui.button_width(tr("Browse"), browse), 12);
  bool entered = ui.text_field("study_file", file, state.study_file, tr("path of a study file"),
                               state.dialog_is_new);
  const bool browses = ui.button("browse", at_right, tr("Browse"), browse);
  ui.heading(below.take_top(18, 6), tr("Folder of the new study"));
  propose_folder(model, state);
  entered |= ui.text_field("new_folder", below.take_top(46), state.new_folder,
                           tr("path of a folder that does not exist yet"));
  const bool ready = !study_of(model, state).empty() && !state.new_folder.empty();
  const DialogChoice choice = draw_dialog_buttons(ui, buttons, tr("Begin"), ready, entered);
  ui.end_dialog();
  // Enter ends a field. If something is still missing, the field gets the keyboard again.
  state.dialog_is_new = entered && !choice.done;
  if (choice.done) result.create = {study_of(model, state), typed_path(state.new_folder)};
  if (choice.done || choice.cancelled) state.dialog = StartViewState::Dialog::kNone;
  if (browses) {
    state.dialog = StartViewState::Dialog::kBrowse;
    begin_file_dialog(state.opening, default_study_folder("study").parent_path());
  }
}

void draw_browse_dialog(Ui& ui, const EntriesOf& entries_of, StartViewState& state) {
  const auto study_files = [&entries_of](const fs::path& folder) {
    std::vector<FolderEntry> entries = entries_of(folder);
    std::erase_if(entries, [](const FolderEntry& entry) {
      return entry.kind != FolderEntry::Kind::kFolder &&
             entry.kind != FolderEntry::Kind::kStudyFile;
    });
    return entries;
  };
  const FileDialogResult found =
      draw_file_dialog(ui,
                       {.title = tr("A study file"),
                        .hint = tr("path of a study file"),
                        .nothing = tr("There is no study file and no folder here.")},
                       study_files, state.opening);
  if (found.chosen) state.study_file = found.chosen->string();
  if (!found.is_closed) return;
  state.dialog = StartViewState::Dialog::kNew;
  state.dialog_is_new = true;
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
