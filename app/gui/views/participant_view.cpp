#include "app/gui/views/participant_view.h"

#include <algorithm>

#include "app/gui/hand_sign.h"
#include "app/gui/views/run_parts.h"

namespace jnd::app::gui {

void draw_participant_view(Ui& ui, const SessionView& view) {
  Rect screen = ui.screen();
  Rect foot = screen.take_bottom(48);
  ui.progress(foot.middle(foot.width * 0.6f, 10), view.done_ratio);
  Stack stack(ui);
  const float size = std::min(360.0f, screen.height * 0.45f);
  if (view.sign != HandSign::kNone) {
    stack.add(size, 48, [&](const Rect& strip) {
      draw_hand_sign(ui, strip.middle(size, size), view.sign);
    });
  }
  stack.add_text(view.participant_text, Font::kHuge, Colour::kInk, screen.width * 0.8f, 0);
  stack.draw(screen);
}

}  // namespace jnd::app::gui
