#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/gui/text_layout.h"
#include "app/gui/ui.h"
#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

constexpr float kChipHeight = 26;

/// Reads the code point at `position` and moves on to the next.
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
  const auto lines = break_lines(words, px(width), measure_of(*theme_.font(style.font)), false);
  return static_cast<float>(lines.size()) * line_height(style.font);
}

/// Every glyph on a whole pixel, as FreeType drew it, while the pen between them keeps the
/// font's own fractions: sharp letters in lines of the right length. `y` is the top of the
/// line.
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
  const Measure measure = measure_of(*theme_.font(style.font));
  const float height = line_height(style.font);
  const auto draw = [&](std::string_view line, float y, bool is_cut) {
    const float free = place.width - measure(line) / theme_.scale();
    float x = place.x;
    if (style.align == Align::kCentre) x += free / 2;
    if (style.align == Align::kRight) x += free;
    draw_line_of_text(x, y, {.words = std::string(line), .box = place, .is_cut = is_cut},
                      style.font, rgba(style.colour));
  };
  if (!style.wrap) {
    const float room = std::max(0.0f, place.height - height);
    // A rounding error is no reason for an ellipsis.
    const std::string shown = shorten(words, px(place.width) + 1, measure);
    draw(shown, place.y + room / 2, shown != words);
    return height;
  }
  const auto lines =
      break_lines(words, px(place.width), measure, style.align == Align::kCentre);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    // The next line begins where this one ends only if there was no space to break at.
    const bool is_within_word =
        i + 1 < lines.size() && lines[i].data() + lines[i].size() == lines[i + 1].data();
    draw(lines[i], place.y + static_cast<float>(i) * height, is_within_word);
  }
  return static_cast<float>(lines.size()) * height;
}

void Ui::heading(const Rect& place, std::string_view words, std::string_view unit,
                 Align align) {
  log_text(words);
  const std::string capitals = in_capitals(words);
  const Measure measure = measure_of(*theme_.font(Font::kCaps));
  const float unit_width =
      unit.empty() ? 0 : text_width(unit, Font::kSmall) + text_width(" · ", Font::kSmall);
  const std::string shown = shorten(capitals, px(place.width - unit_width) + 1, measure);
  const float width = measure(shown) / theme_.scale();
  float x = place.x;
  if (align == Align::kCentre) x += (place.width - width - unit_width) / 2;
  if (align == Align::kRight) x += place.width - width - unit_width;
  const float y = place.y + std::max(0.0f, place.height - line_height(Font::kCaps)) / 2;
  draw_line_of_text(x, y, {.words = shown, .box = place, .is_cut = shown != capitals},
                    Font::kCaps, rgba(Colour::kSoft));
  if (unit.empty()) return;
  log_text(unit);
  // On one base line with the capitals, whose letters are smaller.
  const float lift = (line_height(Font::kSmall) - line_height(Font::kCaps)) / 2;
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
  // On a filled button the cap is drawn in the colour of its letters, on a card in that of
  // lines.
  const bool is_on_filled = colour == Colour::kOnFilled || colour == Colour::kOnStop;
  const std::uint32_t border = is_on_filled ? rgba(colour, 0.55f) : rgba(Colour::kLine);
  const ImVec2 low(std::round(px(place.x)), std::round(px(place.y)));
  const ImVec2 high(std::round(px(place.right())), std::round(px(place.bottom())));
  const float pixel = std::max(1.0f, std::round(px(1)));
  if (!is_on_filled) draw_list().AddRectFilled(low, high, rgba(Colour::kCard), px(4));
  draw_list().AddRect(low, high, border, px(4), 0, pixel);
  // A key is seen from the front: its lower edge is thicker.
  draw_list().AddRectFilled(ImVec2(low.x + px(3), high.y - 2 * pixel),
                            ImVec2(high.x - px(3), high.y - pixel), border);
  const float width = run_width_px(*theme_.font(Font::kKeyCap), words);
  const float left = place.x + (place.width - width / theme_.scale()) / 2;
  const float top = place.y + (kKeyCapHeight - line_height(Font::kKeyCap)) / 2 - 0.5f;
  draw_line_of_text(left, top, {.words = words, .box = place}, Font::kKeyCap, rgba(colour));
  return place.width;
}

}  // namespace jnd::app::gui
