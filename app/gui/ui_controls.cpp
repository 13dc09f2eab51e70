#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/gui/text_layout.h"
#include "app/gui/ui.h"
#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

constexpr double kRepeatDelayS = 0.4;
constexpr double kRepeatIntervalS = 0.08;
constexpr float kKeyCapGap = 9;

Font font_of(const ButtonStyle& style) {
  if (style.large) return Font::kAnswer;
  return style.tone == Tone::kQuiet && !style.selected ? Font::kBody : Font::kStrong;
}

/// Smaller fonts for a button, the largest first.
std::vector<Font> smaller_fonts_of(const ButtonStyle& style) {
  const bool is_regular = font_of(style) == Font::kBody;
  if (style.large) return {Font::kStrong, Font::kSmallStrong, Font::kTiny};
  return {is_regular ? Font::kSmall : Font::kSmallStrong, Font::kTiny};
}

bool shows_key(const ButtonStyle& style) {
  return style.key.key != Key::kNone && !style.hides_key;
}

float padding_of(const ButtonStyle& style) {
  if (style.large) return 28;
  return style.tone == Tone::kQuiet ? 10 : 18;
}

}  // namespace

Ui::Press Ui::press_on(const Rect& place, const ButtonStyle& style) {
  Implementation& my = *my_;
  Press press;
  if (!style.enabled) return press;
  const bool is_under_mouse = my.mouse_is_on(place);
  const bool was_pressed = my.press_was_on(place);
  // A person who presses elsewhere and moves here means what was pressed.
  press.hovered = is_under_mouse && (!my.mouse.down || was_pressed);
  press.held = press.hovered && my.mouse.down;
  if (press.hovered) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);

  if (style.repeats) {
    const double now_s = ImGui::GetTime();
    if (press.held) {
      my.is_repeating = true;
      if (my.went_down) {
        my.next_repeat_s = now_s + kRepeatDelayS;
        my.was_held = false;
        press.answered = true;
      } else if (now_s >= my.next_repeat_s) {
        my.next_repeat_s = now_s + kRepeatIntervalS;
        my.was_held = true;
        press.answered = true;
      }
    }
  } else if (is_under_mouse && was_pressed) {
    press.answered = style.at_once ? my.went_down : my.went_up;
    my.was_used |= press.answered;
  }
  my.note_asked_for(style.key);
  const bool may_take = !style.fresh || my.is_fresh(style.key.key);
  if (!press.answered && may_take && my.take_key(style.key, style.repeats)) {
    press.answered = true;
  }
  return press;
}

bool Ui::button(std::string_view name, const Rect& place, std::string_view label,
                const ButtonStyle& style) {
  log_widget(name, label, style.key, place, style.enabled);
  const Press press = press_on(place, style);
  draw_button(place, label, style, press);
  return press.answered;
}

float Ui::button_width(std::string_view label, const ButtonStyle& style) const {
  float width = text_width(label, font_of(style)) + 2 * padding_of(style);
  if (shows_key(style)) width += kKeyCapGap + key_cap_width(style.key);
  return std::ceil(width);
}

/// How a button shows its label.
struct Ui::ButtonWords {
  Font font = Font::kStrong;
  std::vector<std::string> lines;
  bool has_key = false;
  bool is_cut = false;
};

/// Chooses how a label fits, as other languages have longer words: first smaller letters, then
/// two lines, then without the key. Only after that it is cut.
Ui::ButtonWords Ui::words_on_button(const Rect& place, std::string_view label,
                                    const ButtonStyle& style) const {
  constexpr float kAround = 12, kClosestLines = 1.2f;
  std::vector<Font> fonts = smaller_fonts_of(style);
  fonts.insert(fonts.begin(), font_of(style));
  const float cap = shows_key(style) ? key_cap_width(style.key) + kKeyCapGap : 0;
  for (const bool has_key : {true, false}) {
    if (has_key && cap == 0) continue;
    const float room = place.width - kAround - (has_key ? cap : 0) + 1;
    for (const Font font : fonts) {
      if (text_width(label, font) <= room) return {font, {std::string(label)}, has_key};
    }
    for (const Font font : fonts) {
      if (place.height < 2 * kClosestLines * theme_.size(font) || room < 2) continue;
      const Measure measure = [&](std::string_view part) { return text_width(part, font); };
      const auto lines = break_lines(label, room, measure, /*balanced=*/true);
      if (lines.size() != 2) continue;
      const bool breaks_word = lines[0].data() + lines[0].size() == lines[1].data();
      if (!breaks_word) {
        return {font, {std::string(lines[0]), std::string(lines[1])}, has_key};
      }
    }
  }
  const Measure measure = [&](std::string_view part) { return text_width(part, fonts.back()); };
  return {fonts.back(), {shorten(label, place.width - kAround + 1, measure)}, false, true};
}

void Ui::draw_button(const Rect& place, std::string_view label, const ButtonStyle& style,
                     const Press& press) {
  constexpr float kRounding = 9;
  const bool is_filled = style.tone == Tone::kPrimary || style.tone == Tone::kDanger;
  Colour letters = Colour::kInk;
  if (is_filled && style.enabled) {
    const bool is_danger = style.tone == Tone::kDanger;
    fill(place, is_danger ? Colour::kStop : Colour::kBlue, kRounding);
    letters = is_danger ? Colour::kOnStop : Colour::kOnFilled;
    if (press.hovered) {
      // The shade differs from the letters, so that they stay readable.
      const Colour shade = !theme_.dark() ? Colour::kInk
                           : is_danger    ? Colour::kOnFilled
                                          : Colour::kOnStop;
      fill(place, shade, kRounding, press.held ? 0.24f : 0.12f);
    }
  } else if (style.tone == Tone::kQuiet) {
    letters = style.selected ? Colour::kBlue : press.hovered ? Colour::kInk : Colour::kSoft;
    if (press.hovered) fill(place, Colour::kInk, kRounding, press.held ? 0.12f : 0.06f);
  } else {
    fill(place, style.selected ? Colour::kBlueSoft : Colour::kCard, kRounding);
    if (press.hovered) fill(place, Colour::kBlue, kRounding, press.held ? 0.16f : 0.08f);
    outline(place, style.selected || press.hovered ? Colour::kBlue : Colour::kLine, kRounding);
    if (style.selected) letters = Colour::kBlue;
  }
  if (!style.enabled) letters = Colour::kSoft;

  const ButtonWords set = words_on_button(place, label, style);
  const float cap = set.has_key ? key_cap_width(style.key) + kKeyCapGap : 0;
  float width = 0;
  for (const std::string& line : set.lines) width = std::max(width, text_width(line, set.font));
  const float x = place.x + (place.width - width - cap) / 2;
  const auto count = static_cast<float>(set.lines.size());
  const float height = line_height(set.font);
  const float note_height = line_height(Font::kSmall);
  const bool has_note = !style.note.empty() && place.height >= count * height + note_height;
  const float middle = place.y + (place.height - (has_note ? note_height : 0)) / 2;
  const float step = std::min(height, (place.height - 4) / count);
  float y = middle - (step * (count - 1) + height) / 2;
  for (const std::string& line : set.lines) {
    draw_line_of_text(x + (width - text_width(line, set.font)) / 2, y,
                      {.words = line, .box = place, .is_cut = set.is_cut}, set.font,
                      rgba(letters, style.enabled ? 1.0f : 0.7f));
    y += step;
  }
  if (set.is_cut && press.hovered) tooltip(mouse_x(), mouse_y(), label);
  const bool is_on_fill = is_filled && style.enabled;
  if (has_note) {
    const Rect below{place.x + 6, middle + count * height / 2, place.width - 12, note_height};
    text(below, style.note,
         {.font = Font::kSmall,
          .colour = is_on_fill ? letters : Colour::kSoft,
          .align = Align::kCentre,
          .any_length = true});
  }
  if (!set.has_key) return;
  key_cap(x + width + kKeyCapGap, middle - kKeyCapHeight / 2, style.key,
          is_on_fill ? letters : Colour::kSoft);
}

Ui::Drag Ui::dragged(std::string_view name, const Rect& place) {
  Implementation& my = *my_;
  log_widget(name, "", {}, place, true);
  Drag drag;
  if (my.is_blocked()) return drag;
  if (my.mouse.down && !my.went_down && my.press_was_on(place)) {
    drag.x = my.moved_x;
    drag.y = my.moved_y;
  }
  if (my.mouse_is_on(place)) drag.wheel = std::exchange(my.input.wheel, 0.0f);
  return drag;
}

bool Ui::row(std::string_view name, const Rect& place, std::string_view label,
             const Chord& key) {
  log_widget(name, label, key, place, true);
  const Press press = press_on(place, {.key = key});
  if (press.hovered) fill(place, Colour::kBlue, 8, press.held ? 0.14f : 0.07f);
  return press.answered;
}

}  // namespace jnd::app::gui
