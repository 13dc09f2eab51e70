#include "app/gui/views/list_keys.h"

namespace jnd::app::gui {

bool move_in_list(Ui& ui, std::size_t count, std::optional<std::size_t>& selected) {
  const int step =
      (ui.pressed({Key::kDown}, true) ? 1 : 0) - (ui.pressed({Key::kUp}, true) ? 1 : 0);
  if (count == 0) selected.reset();
  if (selected && *selected >= count) selected = count - 1;
  if (step == 0 || count == 0) return false;
  if (!selected) {
    selected = step > 0 ? 0 : count - 1;
  } else if (step > 0 && *selected + 1 < count) {
    ++*selected;
  } else if (step < 0 && *selected > 0) {
    --*selected;
  }
  return true;
}

void draw_list_keys(Ui& ui, Rect& strip) {
  const Chord up{Key::kUp}, down{Key::kDown};
  const float width = ui.key_cap_width(down);
  const Rect caps = strip.take_right(2 * width + 6, 12);
  const float y = caps.y + (caps.height - Ui::kKeyCapHeight) / 2;
  ui.key_cap(caps.x, y, up);
  ui.key_cap(caps.x + width + 6, y, down);
}

bool DoubleClick::clicked(const std::string& name, double now_s) {
  constexpr double kSoon_s = 0.5;
  const bool is_second = name == name_ && now_s - at_s_ < kSoon_s;
  name_ = is_second ? "" : name;
  at_s_ = now_s;
  return is_second;
}

}  // namespace jnd::app::gui
