#include "app/gui/views/results_cards.h"

namespace jnd::app::gui {
namespace {

constexpr float kValueHeight = 30, kBetween = 12;
constexpr TextStyle kDetail{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};

bool fits_one_line(Ui& ui, float width, const std::string& value, const std::string& detail) {
  return ui.text_width(value, Font::kLarge) + kBetween + 2 +
             ui.text_width(detail, Font::kSmall) <=
         width;
}

}  // namespace

void draw_without_value(Ui& ui, Rect inside, const PlotModel& plot, const std::string& why) {
  const TextStyle amber{.colour = Colour::kAmber, .wrap = true};
  const Rect words = inside.take_bottom(ui.text_height(inside.width, why, amber), 8);
  (void)draw_plot(ui, inside, plot);
  ui.text(words, why, amber);
}

float value_height(Ui& ui, float width, const analysis::Chart& chart) {
  if (fits_one_line(ui, width, chart.value, chart.detail)) return kValueHeight;
  return kValueHeight + ui.text_height(width, chart.detail, kDetail);
}

void draw_value(Ui& ui, Rect line, const std::string& value, const std::string& detail) {
  const TextStyle large{.font = Font::kLarge};
  if (fits_one_line(ui, line.width, value, detail)) {
    ui.text(line.take_left(ui.text_width(value, Font::kLarge) + 2, kBetween), value, large);
    ui.text(line, detail, {.font = Font::kSmall, .colour = Colour::kSoft});
    return;
  }
  ui.text(line.take_top(kValueHeight), value, large);
  ui.text(line, detail, kDetail);
}

}  // namespace jnd::app::gui
