#include "app/gui/views/stack.h"

#include <algorithm>

namespace jnd::app::gui {

/// The next smaller font for words on a card.
static Font smaller_on_card(Font font) {
  switch (font) {
    case Font::kHuge:
      return Font::kTitle;
    case Font::kTitle:
      return Font::kLarge;
    case Font::kLarge:
      return Font::kBody;
    default:
      return Font::kSmall;
  }
}

static TextStyle style_on_card(Font font, Colour colour) {
  return {.font = font, .colour = colour, .align = Align::kCentre, .wrap = true};
}

void Stack::add(float height, float gap_after, std::function<void(const Rect&)> draw) {
  parts_.push_back({height, gap_after, std::move(draw), "", Font::kBody, Colour::kInk, 0});
}

void Stack::add_text(std::string_view words, Font font, Colour colour, float width,
                     float gap_after) {
  if (words.empty()) return;
  const float height = ui_.text_height(width, words, style_on_card(font, colour));
  parts_.push_back({height, gap_after, {}, std::string(words), font, colour, width});
}

float Stack::height() const noexcept {
  float sum = 0;
  for (const Part& part : parts_) sum += part.height + part.gap_after;
  return parts_.empty() ? 0.0f : sum - parts_.back().gap_after;
}

float Stack::height_without_gaps() const noexcept {
  float sum = 0;
  for (const Part& part : parts_) sum += part.height;
  return sum;
}

void Stack::make_letters_smaller() {
  for (Part& part : parts_) {
    if (part.words.empty()) continue;
    part.font = smaller_on_card(part.font);
    part.height =
        ui_.text_height(part.width, part.words, style_on_card(part.font, part.colour));
  }
}

void Stack::draw(const Rect& card) {
  constexpr float kLeastGap = 0.2f;
  const float gaps = height() - height_without_gaps();
  for (int step = 0; step < 2; ++step) {
    if (height_without_gaps() + kLeastGap * gaps <= card.height) break;
    make_letters_smaller();
  }
  const float missing = std::max(0.0f, height() - card.height);
  const float shrink = gaps > 0 ? std::max(kLeastGap, 1.0f - missing / gaps) : 1.0f;
  const float whole = height() - gaps * (1.0f - shrink);
  Rect inside = card;
  const bool scrolls = whole > card.height + 1;
  if (scrolls) inside = ui_.begin_scroll("stack", card, whole);
  float y = inside.y + (scrolls ? 0.0f : (card.height - whole) / 2);
  for (const Part& part : parts_) {
    const Rect place{inside.x, y, inside.width, part.height};
    if (part.words.empty()) {
      part.draw(place);
    } else {
      ui_.text(place.middle(std::min(part.width, place.width), place.height), part.words,
               style_on_card(part.font, part.colour));
    }
    y += part.height + part.gap_after * shrink;
  }
  if (scrolls) ui_.end_scroll();
}

void draw_button_row(Ui& ui, const Rect& strip, const std::vector<RowButton>& buttons,
                     float width) {
  constexpr float kBetween = 12;
  std::vector<float> widths;
  float sum = -kBetween;
  for (const RowButton& button : buttons) {
    widths.push_back(std::max(width, ui.button_width(button.label, button.style)));
    sum += widths.back() + kBetween;
  }
  // If room is short, the widest buttons become narrower, with their words in smaller letters
  // or on two lines.
  if (sum > strip.width) {
    const float gaps = kBetween * static_cast<float>(buttons.size() - 1);
    float most = (strip.width - gaps) / static_cast<float>(buttons.size());
    float spare = 0, num_wide = 0;
    for (const float one : widths) {
      if (one <= most) {
        spare += most - one;
      } else {
        ++num_wide;
      }
    }
    most += num_wide > 0 ? spare / num_wide : 0;
    sum = -kBetween;
    for (float& one : widths) {
      one = std::min(one, most);
      sum += one + kBetween;
    }
  }
  const float shrink = sum > strip.width ? strip.width / sum : 1.0f;
  float x = strip.x + (strip.width - sum * shrink) / 2;
  for (std::size_t i = 0; i < buttons.size(); ++i) {
    const Rect place{x, strip.y, widths[i] * shrink, strip.height};
    if (ui.button(buttons[i].name, place, buttons[i].label, buttons[i].style)) {
      buttons[i].act();
    }
    x += (widths[i] + kBetween) * shrink;
  }
}

}  // namespace jnd::app::gui
