#include "app/gui/views/fitted_text.h"

#include "app/language/words.h"

namespace jnd::app::gui {

std::string fitted(const Ui& ui, const Rect& place, std::string words, const TextStyle& style) {
  constexpr float kRounding = 1;
  if (place.height + kRounding < ui.line_height(style.font)) return "";
  std::string shown = words;
  while (ui.text_height(place.width, shown, style) > place.height + kRounding) {
    const std::size_t blank = words.rfind(' ');
    if (blank == std::string::npos) break;
    words.resize(blank);
    shown = words + as_is(" …");
  }
  return shown;
}

float draw_fitted(Ui& ui, const Rect& place, const std::string& words, const TextStyle& style) {
  const std::string shown = fitted(ui, place, words, style);
  if (shown.empty()) return 0;
  if (shown != words && ui.hovered(place)) ui.tooltip(ui.mouse_x(), ui.mouse_y(), words);
  return ui.text(place, shown, style);
}

}  // namespace jnd::app::gui
