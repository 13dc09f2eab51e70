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

std::vector<Rect> cells_of(const Rect& line, const std::vector<ColumnLook>& columns,
                           float between) {
  float shares = 0;
  for (const ColumnLook& column : columns) shares += column.share;
  const float room = line.width - between * static_cast<float>(columns.size() - 1);
  std::vector<Rect> cells;
  float x = line.x;
  for (const ColumnLook& column : columns) {
    const float width = room * column.share / shares;
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
