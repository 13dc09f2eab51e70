#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/gui/text_layout.h"
#include "app/gui/ui.h"
#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

constexpr float kChipHeight = 26;

/// Reads the code point at `position` and moves on to the next one.
unsigned next_code_point(std::string_view text, std::size_t& position) {
  unsigned code_point = 0;
  const int length =
      ImTextCharFromUtf8(&code_point, text.data() + position, text.data() + text.size());
  position += static_cast<std::size_t>(std::max(1, length));
  return code_point <= IM_UNICODE_CODEPOINT_MAX ? code_point : IM_UNICODE_CODEPOINT_INVALID;
}

float run_width_px(const ImFont& font, std::string_view text) {
  float width = 0;
  for (std::size_t i = 0; i < text.size();) {
    width += font.GetCharAdvance(static_cast<ImWchar>(next_code_point(text, i)));
  }
  return width;
}

Measure measure_of(const ImFont& font) {
  return [&font](std::string_view text) { return run_width_px(font, text); };
}

/// The font for words that have no room in this one.
std::optional<Font> smaller(Font font) {
  switch (font) {
    case Font::kHuge:
      return Font::kTitle;
    case Font::kTitle:
      return Font::kLarge;
    case Font::kLarge:
    case Font::kAnswer:
      return Font::kStrong;
    case Font::kStrong:
      return Font::kSmallStrong;
    case Font::kBody:
      return Font::kSmall;
    case Font::kSmall:
    case Font::kSmallStrong:
      return Font::kTiny;
    case Font::kMono:
      return Font::kKeyCap;
    case Font::kTiny:
    case Font::kCaps:
    case Font::kKeyCap:
      break;
  }
  return std::nullopt;
}

/// True if the line breaks within a word: then the next line begins exactly where this one
/// ends.
bool breaks_word(const std::vector<std::string_view>& lines, std::size_t i) {
  return i + 1 < lines.size() && lines[i].data() + lines[i].size() == lines[i + 1].data();
}

bool breaks_words(const std::vector<std::string_view>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (breaks_word(lines, i)) return true;
  }
  return false;
}

/// How words are set.
struct SetWords {
  Font font;
  std::vector<std::string_view> lines;
};

/// Sets wrapped words in smaller letters before one of them is broken.
SetWords wrapped(const Theme& theme, std::string_view words, float width_px, Font font,
                 bool balanced) {
  const auto set = [&](Font in) {
    return SetWords{in, break_lines(words, width_px, measure_of(*theme.font(in)), balanced)};
  };
  SetWords wanted = set(font);
  if (!breaks_words(wanted.lines)) return wanted;
  for (std::optional<Font> next = smaller(font); next; next = smaller(*next)) {
    SetWords tried = set(*next);
    if (!breaks_words(tried.lines)) return tried;
  }
  return wanted;
}

/// The least distance between lines, as a multiple of their em square.
constexpr float kClosestLines = 1.15f;

/// Fits words into the middle of a place, on one line if possible; none if they have no room.
std::optional<SetWords> fitted_into(const Theme& theme, const Rect& place,
                                    std::string_view words, const TextStyle& style) {
  // A rounding error alone must not cause an ellipsis.
  const float room_px = theme.scale() * place.width + 1;
  std::optional<Font> font = style.font;
  for (int step = 0; font; font = smaller(*font), ++step) {
    // Values and titles are rather cut than made hard to read.
    if (style.any_length && step > 1) break;
    const Measure measure = measure_of(*theme.font(*font));
    if (measure(words) <= room_px) return SetWords{*font, {words}};
    const auto most = static_cast<std::size_t>(
        std::max(0.0f, place.height / (kClosestLines * theme.size(*font))));
    // Numbers become smaller rather than take two lines.
    if (most < 2 || *font == Font::kMono || room_px < 2) continue;
    auto lines = break_lines(words, room_px, measure, style.align == Align::kCentre);
    if (lines.size() <= most && !breaks_words(lines)) return SetWords{*font, std::move(lines)};
  }
  return std::nullopt;
}

}  // namespace

float Ui::text_width(std::string_view words, Font font) const {
  return std::ceil(run_width_px(*theme_.font(font), words)) / theme_.scale();
}

float Ui::line_height(Font font) const {
  const bool is_display = font == Font::kTitle || font == Font::kHuge;
  return std::round(theme_.size(font) * (is_display ? 1.22f : 1.38f));
}

float Ui::text_height(float width, std::string_view words, const TextStyle& style) const {
  if (!style.wrap) return line_height(style.font);
  const SetWords set = wrapped(theme_, words, px(width), style.font, false);
  return static_cast<float>(set.lines.size()) * line_height(set.font);
}

/// Draws each glyph on a whole pixel, as FreeType drew it, while the pen keeps the font's own
/// fractions. So letters are sharp and lines have the right length. `y` is the top of the line.
void Ui::draw_line_of_text(float x, float y, const Drawn::Line& line, Font font_role,
                           std::uint32_t colour) {
  const std::string_view words = line.words;
  const ImFont& font = *theme_.font(font_role);
  log_line({x, y, run_width_px(font, words) / theme_.scale(), line_height(font_role)}, line);
  ImDrawList& list = draw_list();
  const float space = px(line_height(font_role)) - font.FontSize;
  const float top = std::round(px(y) + space / 2);
  const ImVec4 clip(list.GetClipRectMin().x, list.GetClipRectMin().y, list.GetClipRectMax().x,
                    list.GetClipRectMax().y);
  if (top > clip.w || top + font.FontSize < clip.y) return;
  const auto most = static_cast<int>(words.size());
  list.PrimReserve(6 * most, 4 * most);
  int num_drawn = 0;
  float pen = px(x);
  for (std::size_t i = 0; i < words.size();) {
    const auto code_point = static_cast<ImWchar>(next_code_point(words, i));
    const ImFontGlyph* glyph = font.FindGlyph(code_point);
    if (glyph == nullptr) continue;
    if (glyph->Visible) {
      const float left = std::round(pen);
      list.PrimRectUV(ImVec2(left + glyph->X0, top + glyph->Y0),
                      ImVec2(left + glyph->X1, top + glyph->Y1), ImVec2(glyph->U0, glyph->V0),
                      ImVec2(glyph->U1, glyph->V1), colour);
      ++num_drawn;
    }
    pen += glyph->AdvanceX;
  }
  list.PrimUnreserve(6 * (most - num_drawn), 4 * (most - num_drawn));
}

float Ui::text(const Rect& place, std::string_view words, const TextStyle& style) {
  log_text(words);
  const auto draw = [&](std::string_view line, Font font, float y, bool is_cut) {
    const float free = place.width - run_width_px(*theme_.font(font), line) / theme_.scale();
    float x = place.x;
    if (style.align == Align::kCentre) x += free / 2;
    if (style.align == Align::kRight) x += free;
    draw_line_of_text(x, y,
                      {.words = std::string(line),
                       .box = place,
                       .is_cut = is_cut,
                       .shows_whole = is_cut && style.any_length},
                      font, rgba(style.colour));
    if (is_cut && hovered(place)) tooltip(mouse_x(), mouse_y(), words);
  };
  if (style.wrap) {
    const bool balanced = style.align == Align::kCentre;
    const auto [font, lines] = wrapped(theme_, words, px(place.width), style.font, balanced);
    const float height = line_height(font);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      draw(lines[i], font, place.y + static_cast<float>(i) * height, breaks_word(lines, i));
    }
    return static_cast<float>(lines.size()) * height;
  }
  if (const auto set = fitted_into(theme_, place, words, style)) {
    const auto count = static_cast<float>(set->lines.size());
    const float height = line_height(set->font);
    const float step = count > 1 ? std::min(height, place.height / count) : height;
    const float room = std::max(0.0f, place.height - step * (count - 1) - height);
    // Lines that are close together extend beyond the place by their empty margins.
    float y = place.y + room / 2;
    if (count > 1 && room <= 0) y = place.y + (step - height) / 2;
    for (const std::string_view line : set->lines) {
      draw(line, set->font, y, false);
      y += step;
    }
    return height + step * (count - 1);
  }
  const std::string shown =
      shorten(words, px(place.width) + 1, measure_of(*theme_.font(style.font)));
  const float height = line_height(style.font);
  draw(shown, style.font, place.y + std::max(0.0f, place.height - height) / 2, true);
  return height;
}

void Ui::heading(const Rect& place, std::string_view words, std::string_view unit, Align align,
                 bool any_length) {
  log_text(words);
  const float unit_width =
      unit.empty() ? 0 : text_width(unit, Font::kSmall) + text_width(" · ", Font::kSmall);
  const float room_px = px(place.width - unit_width) + 1;
  Font font = Font::kCaps;
  std::string whole = in_capitals(words);
  for (const Font small : {Font::kSmallStrong, Font::kTiny}) {
    if (measure_of(*theme_.font(font))(whole) <= room_px) break;
    font = small;
    whole = words;
  }
  const Measure measure = measure_of(*theme_.font(font));
  const std::string shown = shorten(whole, room_px, measure);
  const bool is_cut = shown != whole;
  const float width = measure(shown) / theme_.scale();
  float x = place.x;
  if (align == Align::kCentre) x += (place.width - width - unit_width) / 2;
  if (align == Align::kRight) x += place.width - width - unit_width;
  const float y = place.y + std::max(0.0f, place.height - line_height(font)) / 2;
  draw_line_of_text(
      x, y,
      {.words = shown, .box = place, .is_cut = is_cut, .shows_whole = is_cut && any_length},
      font, rgba(Colour::kSoft));
  if (is_cut && hovered(place)) tooltip(mouse_x(), mouse_y(), words);
  if (unit.empty()) return;
  log_text(unit);
  // The unit is on one base line with the capitals, whose letters are smaller.
  const float lift = (line_height(Font::kSmall) - line_height(font)) / 2;
  draw_line_of_text(x + width, y - lift, {.words = " · " + std::string(unit), .box = place},
                    Font::kSmall, rgba(Colour::kSoft));
}

float Ui::chip_width(std::string_view words) const {
  return text_width(words, Font::kSmallStrong) + 24;
}

float Ui::chip(float x, float y, std::string_view words, Colour colour) {
  const Rect place = {x, y, chip_width(words), kChipHeight};
  if (colour == Colour::kBlue) {
    fill(place, Colour::kBlueSoft, kChipHeight / 2);
  } else {
    fill(place, colour, kChipHeight / 2, kChipAlpha);
  }
  text(place, words, {.font = Font::kSmallStrong, .colour = colour, .align = Align::kCentre});
  return place.width;
}

float Ui::key_cap_width(const Chord& key) const {
  return std::max(kKeyCapHeight, text_width(printed_words(key), Font::kKeyCap) + 13);
}

float Ui::key_cap(float x, float y, const Chord& key, Colour colour) {
  const std::string words = printed_words(key);
  const Rect place = {x, y, key_cap_width(key), kKeyCapHeight};
  log_text(words);
  // On a filled button, the cap's border has the colour of its letters; on a card, that of
  // lines.
  const bool is_on_filled = colour == Colour::kOnFilled || colour == Colour::kOnStop;
  const std::uint32_t border = is_on_filled ? rgba(colour, 0.55f) : rgba(Colour::kLine);
  const ImVec2 low(std::round(px(place.x)), std::round(px(place.y)));
  const ImVec2 high(std::round(px(place.right())), std::round(px(place.bottom())));
  const float pixel = std::max(1.0f, std::round(px(1)));
  if (!is_on_filled) draw_list().AddRectFilled(low, high, rgba(Colour::kCard), px(4));
  draw_list().AddRect(low, high, border, px(4), 0, pixel);
  // The lower edge is thicker, because a key is seen from the front.
  draw_list().AddRectFilled(ImVec2(low.x + px(3), high.y - 2 * pixel),
                            ImVec2(high.x - px(3), high.y - pixel), border);
  const float width = run_width_px(*theme_.font(Font::kKeyCap), words);
  const float left = place.x + (place.width - width / theme_.scale()) / 2;
  const float top = place.y + (kKeyCapHeight - line_height(Font::kKeyCap)) / 2 - 0.5f;
  draw_line_of_text(left, top, {.words = words, .box = place}, Font::kKeyCap, rgba(colour));
  return place.width;
}

}  // namespace jnd::app::gui
