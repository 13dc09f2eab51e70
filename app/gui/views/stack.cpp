#include "app/gui/views/stack.h"

#include <algorithm>

namespace jnd::app::gui {

void Stack::add(float height, float gap_after, std::function<void(const Rect&)> draw) {
  parts_.push_back({height, gap_after, std::move(draw)});
}

void Stack::add_text(std::string_view words, Font font, Colour colour, float width,
                     float gap_after) {
  if (words.empty()) return;
  const TextStyle style{.font = font, .colour = colour, .align = Align::kCentre, .wrap = true};
  add(ui_.text_height(width, words, style), gap_after,
      [this, words = std::string(words), style, width](const Rect& place) {
        ui_.text(place.middle(width, place.height), words, style);
      });
}

float Stack::height() const noexcept {
  float sum = 0;
  for (const Part& part : parts_) sum += part.height + part.gap_after;
  return parts_.empty() ? 0.0f : sum - parts_.back().gap_after;
}

void Stack::draw(const Rect& card) {
  // Where room is short the gaps give way first.
  float gaps = 0;
  for (std::size_t i = 0; i + 1 < parts_.size(); ++i) gaps += parts_[i].gap_after;
  const float missing = std::max(0.0f, height() - card.height);
  constexpr float kLeastGap = 0.2f;
  const float shrink = gaps > 0 ? std::max(kLeastGap, 1.0f - missing / gaps) : 1.0f;
  const float whole = height() - gaps * (1.0f - shrink);
  float y = card.y + std::max(0.0f, (card.height - whole) / 2);
  for (const Part& part : parts_) {
    part.draw({card.x, y, card.width, part.height});
    y += part.height + part.gap_after * shrink;
  }
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
  // What does not fit is narrower; words are cut before a button is lost.
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
