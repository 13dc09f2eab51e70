#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/gui/ui.h"

namespace jnd::app::gui {

/// Things below each other in the middle of a card.
class Stack {
 public:
  explicit Stack(Ui& ui) : ui_(ui) {}

  /// Adds a thing. `draw` gets a rectangle of the card's width and this height.
  void add(float height, float gap_after, std::function<void(const Rect&)> draw);
  /// Adds words, centred and wrapped; adds nothing if there are none.
  void add_text(std::string_view words, Font font, Colour colour, float width, float gap_after);
  /// Draws everything in the middle of the card. If there is too little room, first the gaps
  /// become smaller, then the letters; at last the card scrolls.
  void draw(const Rect& card);
  [[nodiscard]] float height() const noexcept;

 private:
  struct Part {
    float height, gap_after;
    std::function<void(const Rect&)> draw;
    std::string words;  ///< The words, if this part is a text.
    Font font = Font::kBody;
    Colour colour = Colour::kInk;
    float width = 0;
  };
  void make_letters_smaller();
  [[nodiscard]] float height_without_gaps() const noexcept;

  Ui& ui_;
  std::vector<Part> parts_;
};

struct RowButton {
  std::string_view name, label;
  ButtonStyle style;
  std::function<void()> act;
};
/// Draws buttons side by side in the middle of a strip. If `width` > 0, each is at least so
/// wide.
void draw_button_row(Ui& ui, const Rect& strip, const std::vector<RowButton>& buttons,
                     float width = 0.0f);

}  // namespace jnd::app::gui
