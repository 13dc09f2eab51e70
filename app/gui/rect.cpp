#include <algorithm>

#include "app/gui/ui.h"

namespace jnd::app::gui {

Rect Rect::take_top(float strip, float gap) noexcept {
  const Rect taken = {x, y, width, strip};
  y += strip + gap;
  height -= strip + gap;
  return taken;
}

Rect Rect::take_bottom(float strip, float gap) noexcept {
  height -= strip + gap;
  return {x, y + height + gap, width, strip};
}

Rect Rect::take_left(float strip, float gap) noexcept {
  const Rect taken = {x, y, strip, height};
  x += strip + gap;
  width -= strip + gap;
  return taken;
}

Rect Rect::take_right(float strip, float gap) noexcept {
  width -= strip + gap;
  return {x + width + gap, y, strip, height};
}

Rect Rect::middle(float its_width, float its_height) const noexcept {
  return {x + (width - its_width) / 2, y + (height - its_height) / 2, its_width, its_height};
}

Rect Rect::common(const Rect& other) const noexcept {
  const float left = std::max(x, other.x);
  const float top = std::max(y, other.y);
  return {left, top, std::max(0.0f, std::min(right(), other.right()) - left),
          std::max(0.0f, std::min(bottom(), other.bottom()) - top)};
}

}  // namespace jnd::app::gui
