#include "app/gui/views/results_cards.h"

namespace jnd::app::gui {

void draw_without_value(Ui& ui, Rect inside, const PlotModel& plot, const std::string& why) {
  const TextStyle amber{.colour = Colour::kAmber, .wrap = true};
  const Rect words = inside.take_bottom(ui.text_height(inside.width, why, amber), 8);
  (void)draw_plot(ui, inside, plot);
  ui.text(words, why, amber);
}

void draw_value(Ui& ui, Rect line, const std::string& value, const std::string& detail) {
  const float width = ui.text_width(value, Font::kLarge) + 2;
  ui.text(line.take_left(width, 12), value, {.font = Font::kLarge});
  ui.text(line, detail, {.font = Font::kSmall, .colour = Colour::kSoft});
}

}  // namespace jnd::app::gui
