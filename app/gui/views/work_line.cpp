#include "app/gui/views/work_line.h"

#include <cmath>

#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {

float work_height(const Ui& ui, float width, const StudyWork& work) {
  if (!work.running.empty()) return 42;
  if (work.outcome.sentence.empty()) return 0;
  const TextStyle style{.font = Font::kSmall, .wrap = true};
  float height = ui.text_height(width, work.outcome.sentence, style) + 8;
  for (const std::string& problem : work.outcome.problems) {
    height += ui.text_height(width, problem, style) + 6;
  }
  return height;
}

bool draw_work(Ui& ui, Rect place, const StudyWork& work) {
  if (!work.running.empty()) {
    const ButtonStyle style{.key = {Key::kF2}};
    Rect line = place.take_top(42);
    const float width = ui.button_width(tr("Cancel"), style);
    const bool cancelled =
        ui.button("cancel_work", line.take_right(width, 14), tr("Cancel"), style);
    const auto percent = std::to_string(std::lround(100.0 * work.progress));
    ui.text(line.take_top(24, 6), work.running + " · " + percent + " %", {});
    ui.progress(line.take_top(8), work.progress);
    return cancelled;
  }
  if (work.outcome.sentence.empty()) return false;
  const TextStyle style{.font = Font::kSmall,
                        .colour = work.outcome.ok ? Colour::kGreen : Colour::kRed,
                        .wrap = true};
  ui.text(place.take_top(ui.text_height(place.width, work.outcome.sentence, style), 8),
          work.outcome.sentence, style);
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  for (const std::string& problem : work.outcome.problems) {
    const float height = ui.text_height(place.width, problem, soft);
    if (height > place.height + 1) break;
    ui.text(place.take_top(height, 6), problem, soft);
  }
  return false;
}

}  // namespace jnd::app::gui
