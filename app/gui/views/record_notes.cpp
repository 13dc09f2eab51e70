// Shows what was written down in a session: notes, adverse events, and why it was paused or
// ended.

#include <utility>

#include "app/gui/views/layout.h"
#include "app/gui/views/record_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

struct NoteLook {
  const char* words;
  Colour colour;
};

NoteLook look_of_note(RecordNote::Kind kind) {
  switch (kind) {
    case RecordNote::Kind::kNote:
      return {tr("note"), Colour::kBlue};
    case RecordNote::Kind::kAdverseEvent:
      return {tr("adverse event"), Colour::kRed};
    case RecordNote::Kind::kPause:
      return {tr("pause"), Colour::kAmber};
    case RecordNote::Kind::kEnd:
      return {tr("ended early"), Colour::kAmber};
    case RecordNote::Kind::kAsked:
      return {tr("unlikely answer"), Colour::kAmber};
  }
  return {"", Colour::kSoft};
}

constexpr float kNotePadding = 8;
constexpr TextStyle kNoteText{.wrap = true};

float height_of_note(const Ui& ui, float width, const RecordNote& note) {
  return 26 + 4 + ui.text_height(width - 16, note.text, kNoteText) + 2 * kNotePadding;
}

void draw_note(Ui& ui, const Rect& row, const RecordNote& note, std::size_t place,
               RecordViewState& state) {
  if (state.note == place) ui.fill(row, Colour::kBlueSoft, 8);
  if (ui.row("note_" + std::to_string(place + 1), row, note.text)) state.note = place;
  Rect inside = row;
  inside.take_left(8);
  inside.take_right(8);
  inside.take_top(kNotePadding);
  Rect head = inside.take_top(26, 4);
  const NoteLook look = look_of_note(note.kind);
  head.take_left(ui.chip(head.x, head.y, look.words, look.colour), 12);
  const char* read = note.is_read ? tr("acknowledged") : is_new(note) ? tr("new") : "";
  const Colour colour = note.is_read ? Colour::kGreen : Colour::kAmber;
  const float width = ui.text_width(read, Font::kSmallStrong) + 20;
  Rect state_place = head.take_right(width, 12);
  if (note.is_read) {
    ui.check(state_place.x + 6, state_place.y + state_place.height / 2, 10, colour);
  } else if (is_new(note)) {
    ui.dot(state_place.x + 6, state_place.y + state_place.height / 2, 4, colour);
  }
  state_place.take_left(16);
  ui.text(state_place, read, {.font = Font::kSmallStrong, .colour = colour});
  ui.text(head, note.when, {.font = Font::kSmall, .colour = Colour::kSoft});
  ui.text(inside, note.text, kNoteText);
}

std::string empty_notes(const SessionRecord& record, const RecordViewState& state) {
  if (record.notes.empty()) {
    return record.is_backup ? tr("Nothing was written down in this session.")
                            : tr("Nothing was written down in this session. “Write a note” "
                                 "adds what you remember.");
  }
  if (!state.searched.empty()) {
    return tr("No note has “{}” in it. Empty the field to see all of them.", state.searched);
  }
  return tr("Everything was acknowledged. Press U to see all notes.");
}

void draw_search(Ui& ui, Rect strip, RecordViewState& state) {
  const ButtonStyle unread{.key = {letter('U')}, .selected = state.unread_only};
  const Rect at_right = strip.take_right(ui.button_width(tr("Only new ones"), unread), 10);
  if (ui.button("unread_only", at_right, tr("Only new ones"), unread)) {
    state.unread_only = !state.unread_only;
  }
  const ButtonStyle search{.key = {letter('F'), true}};
  const Rect begin = strip.take_right(ui.button_width(tr("Search"), search), 10);
  if (ui.button("search_notes", begin, tr("Search"), search)) state.searches = true;
  (void)ui.text_field("searched", strip, state.searched, tr("words of a note"),
                      std::exchange(state.searches, false));
}

}  // namespace

std::vector<std::size_t> shown_notes(const SessionRecord& record,
                                     const RecordViewState& state) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < record.notes.size(); ++i) {
    const RecordNote& note = record.notes[i];
    if (state.unread_only && !is_new(note)) continue;
    if (is_found(note, state.searched)) shown.push_back(i);
  }
  return shown;
}

const RecordNote* chosen_note(const SessionRecord& record, const RecordViewState& state) {
  const std::vector<std::size_t> shown = shown_notes(record, state);
  if (!state.note || *state.note >= shown.size()) return nullptr;
  return &record.notes[shown[*state.note]];
}

void draw_record_notes(Ui& ui, const Rect& place, const SessionRecord& record,
                       RecordViewState& state) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  Rect title = inside.take_top(20, 8);
  const std::vector<std::size_t> shown = shown_notes(record, state);
  if (shown.size() > 1) draw_list_keys(ui, title);
  ui.heading(title, tr("Notes"));
  if (!record.notes.empty()) draw_search(ui, inside.take_top(42, 10), state);
  if (shown.empty()) {
    state.note.reset();
    draw_notice(ui, inside, empty_notes(record, state));
    return;
  }
  if (!state.note) state.note = 0;
  const bool moved = move_in_list(ui, shown.size(), state.note);
  const float width = inside.width - (state.notes_height > inside.height ? 16 : 0);
  float content = 0;
  float chosen_from = 0, chosen_height = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const float height = height_of_note(ui, width, record.notes[shown[i]]);
    if (state.note == i) {
      chosen_from = content;
      chosen_height = height;
    }
    content += height;
  }
  state.notes_height = content;
  if (moved) ui.scroll_into_view("notes", chosen_from, chosen_height);
  Rect rows = ui.begin_scroll("notes", inside, content);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const RecordNote& note = record.notes[shown[i]];
    const Rect row = rows.take_top(height_of_note(ui, width, note));
    draw_note(ui, row, note, i, state);
    ui.line(row.x, row.bottom(), row.right(), row.bottom(), Colour::kLine);
  }
  ui.end_scroll();
}

}  // namespace jnd::app::gui
