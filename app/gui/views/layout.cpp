#include "app/gui/views/layout.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/language/words.h"

namespace jnd::app::gui {

Rect draw_card(Ui& ui, const Rect& place, std::string_view heading, std::string_view unit) {
  ui.card(place);
  Rect inside = place.inset(kPadding);
  if (!heading.empty()) ui.heading(inside.take_top(18, 10), heading, unit);
  return inside;
}

std::vector<CornerButton> corner_buttons(const Ui& ui) {
  const bool is_dark = ui.theme().dark();
  return {{"keys", tr("All keys"), {Key::kF1}},
          {"larger", tr("Larger"), {Key::kPlus, true}},
          {"dark", is_dark ? tr("Light") : tr("Dark"), {letter('D'), true}}};
}

CornerLook corner_look(const Ui& ui, std::string_view language) {
  constexpr float kBetween = 2, kFromEdge = 12;
  CornerLook look;
  for (const bool has_keys : {true, false}) {
    look = {.width = kFromEdge, .has_keys = has_keys};
    const auto add = [&](std::string_view label, Chord key) {
      look.width +=
          ui.button_width(label, {.tone = Tone::kQuiet, .key = key, .hides_key = !has_keys}) +
          kBetween;
    };
    for (const CornerButton& button : corner_buttons(ui)) add(button.label, button.key);
    if (!language.empty()) add(language, {letter('L'), true});
    // The language button is on the start screen, whose footer has few words.
    const float most = language.empty() ? 0.5f : 0.75f;
    if (look.width <= most * ui.screen().width) break;
  }
  return look;
}

void need_room(const Ui& ui, ColumnLook& column, std::string_view words, Font font) {
  column.least_width = std::max(column.least_width, ui.text_width(words, font) + 1);
}

static float widest_word_of_line(const Ui& ui, std::string_view words, Font font) {
  float widest = 0;
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(' '));
    widest = std::max(widest, ui.text_width(word, font));
    words.remove_prefix(std::min(word.size() + 1, words.size()));
  }
  return widest;
}

void need_room_for_titles(const Ui& ui, std::vector<ColumnLook>& columns) {
  for (ColumnLook& column : columns) {
    const float widest = widest_word_of_line(ui, column.title, Font::kSmallStrong);
    if (widest > 0) column.least_width = std::max(column.least_width, widest + 1);
  }
}

/// Each column gets at least the width that its words need, and the columns share the rest. If
/// there is too little room for that, all columns are narrower in proportion.
static std::vector<float> widths_of(const std::vector<ColumnLook>& columns, float room) {
  std::vector<float> widths(columns.size(), 0.0f);
  float least = 0;
  for (const ColumnLook& column : columns) least += column.least_width;
  if (least >= room) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      widths[i] = columns[i].least_width * room / least;
    }
    return widths;
  }
  std::vector<bool> is_set(columns.size(), false);
  for (bool goes_on = true; goes_on;) {
    goes_on = false;
    float shares = 0, left = room;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (is_set[i]) {
        left -= widths[i];
      } else {
        shares += columns[i].share;
      }
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (is_set[i]) continue;
      widths[i] = left * columns[i].share / shares;
      if (widths[i] >= columns[i].least_width) continue;
      widths[i] = columns[i].least_width;
      is_set[i] = goes_on = true;
    }
  }
  return widths;
}

std::vector<Rect> cells_of(const Rect& line, const std::vector<ColumnLook>& columns,
                           float between) {
  const float room = line.width - between * static_cast<float>(columns.size() - 1);
  std::vector<Rect> cells;
  float x = line.x;
  for (const float width : widths_of(columns, room)) {
    cells.push_back({x, line.y, width, line.height});
    x += width + between;
  }
  return cells;
}

std::vector<Rect> grid_of(const Rect& place, int count, int columns, float row_height) {
  const auto gaps = static_cast<float>(columns - 1);
  const float width = (place.width - kGap * gaps) / static_cast<float>(columns);
  std::vector<Rect> places;
  for (int i = 0; i < count; ++i) {
    const int row = i / columns;
    const int column = i % columns;
    const bool is_alone = column == 0 && i + 1 == count;
    places.push_back({place.x + static_cast<float>(column) * (width + kGap),
                      place.y + static_cast<float>(row) * (row_height + kGap),
                      is_alone ? place.width : width, row_height});
  }
  return places;
}

void draw_table_head(Ui& ui, Rect& place, const std::vector<ColumnLook>& columns) {
  const Rect head = place.take_top(30);
  const std::vector<Rect> cells = cells_of(head, columns);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string title =
        columns[i].title + (columns[i].unit.empty() ? "" : " " + columns[i].unit);
    ui.text(cells[i], title,
            {.font = Font::kSmallStrong, .colour = Colour::kSoft, .align = columns[i].align});
  }
  ui.line(head.x, head.bottom(), head.right(), head.bottom(), Colour::kLine);
}

DialogChoice draw_dialog_buttons(Ui& ui, Rect row, std::string_view verb, bool enabled,
                                 bool entered) {
  const ButtonStyle primary{.tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = enabled};
  const ButtonStyle plain{.key = {Key::kF2}};
  const Rect verb_place = row.take_right(ui.button_width(verb, primary), 12);
  const Rect cancel_place = row.take_right(ui.button_width(tr("Cancel"), plain), 12);
  DialogChoice choice;
  choice.done = ui.button("dialog_do", verb_place, verb, primary) || (entered && enabled);
  choice.cancelled = ui.button("dialog_cancel", cancel_place, tr("Cancel"), plain);
  return choice;
}

float more_lines(const Ui& ui, float dialog_width, std::string_view words,
                 const TextStyle& style, int num_lines) {
  constexpr float kAround = 2 * 28 + 2 * 12;
  const float width = std::min(dialog_width, ui.screen().width) - kAround;
  const float usual = static_cast<float>(num_lines) * ui.line_height(style.font);
  return std::max(0.0f, ui.text_height(width, words, style) - usual);
}

bool draw_choice(Ui& ui, const std::string& name, const Rect& place, const std::string& label,
                 const std::string& kind, Chord key, bool selected, bool any_length) {
  if (selected) ui.fill(place, Colour::kBlueSoft, 8);
  const bool chosen = ui.row(name, place, label, key);
  Rect words = place;
  words.take_left(12);
  words.take_right(12);
  if (key.key != Key::kNone) {
    const Rect cap = words.take_right(ui.key_cap_width(key), 12);
    ui.key_cap(cap.x, cap.y + (cap.height - 20) / 2, key);
  }
  // The kind gives way to the label, but the label takes at most half of the row from it.
  const float of_label = ui.text_width(label, selected ? Font::kStrong : Font::kBody);
  const float least = std::max(words.width / 2, words.width - of_label - 16);
  const float width = std::min(ui.text_width(kind, Font::kSmall) + 2, least);
  if (!kind.empty()) {
    ui.text(words.take_right(width, 12), kind,
            {.font = Font::kSmall, .colour = Colour::kSoft, .align = Align::kRight});
  }
  ui.text(words, label,
          {.font = selected ? Font::kStrong : Font::kBody,
           .colour = selected ? Colour::kBlue : Colour::kInk,
           .any_length = any_length});
  return chosen;
}

Chord key_of_choice(std::size_t place) noexcept {
  constexpr std::size_t kMostKeys = 9;
  if (place >= kMostKeys) return {};
  return {.key = letter(static_cast<char>('1' + place)), .control = true};
}

Colour colour_of(PreflightLine::Status status) noexcept {
  switch (status) {
    case PreflightLine::Status::kOk:
      return Colour::kGreen;
    case PreflightLine::Status::kWarning:
      return Colour::kAmber;
    case PreflightLine::Status::kFailed:
      return Colour::kRed;
    case PreflightLine::Status::kWaiting:
      break;
  }
  return Colour::kSoft;
}

void draw_name_and_value(Ui& ui, const Rect& line, std::string_view name,
                         const TextStyle& name_style, std::string_view value,
                         const TextStyle& value_style) {
  constexpr float kBetween = 10;
  const float of_name = ui.text_width(name, name_style.font) + 1;
  const float of_value = ui.text_width(value, value_style.font) + 1;
  const float room = line.width - kBetween;
  float width = of_value;
  if (of_name + of_value > room) {
    // If one of the two is short, it gets all the room that it needs. Otherwise they share the
    // room in proportion, but the longest word of the name has to fit.
    const float few = 0.4f * room;
    width = of_name < few    ? room - of_name
            : of_value < few ? of_value
                             : room * std::clamp(of_value / (of_name + of_value), 0.35f, 0.65f);
    const float least_name =
        std::min(widest_word_of_line(ui, name, Font::kTiny) + 1, 0.7f * room);
    width = std::min(width, room - least_name);
  }
  Rect rest = line;
  TextStyle at_right = value_style;
  at_right.align = Align::kRight;
  ui.text(rest.take_right(width, kBetween), value, at_right);
  ui.text(rest, name, name_style);
}

Rect Flow::next(float width) {
  width = std::min(width, area_.width);
  if (x_ > area_.x && x_ + width > area_.right() + 0.5f) {
    x_ = area_.x;
    y_ += height_ + gap_;
  }
  const Rect place{x_, y_, width, height_};
  x_ += width + gap_;
  return place;
}

void draw_notice(Ui& ui, const Rect& place, std::string_view words, Colour colour) {
  const TextStyle style{.colour = colour, .align = Align::kCentre, .wrap = true};
  const float width = std::min(640.0f, place.width - 32);
  ui.text(place.middle(width, ui.text_height(width, words, style)), words, style);
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string table_number(double value) {
  if (!std::isfinite(value)) return "";
  return formatted(std::abs(value) >= 100.0 ? "%.0f" : "%.2f", value);
}

}  // namespace jnd::app::gui
