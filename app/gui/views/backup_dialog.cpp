#include "app/gui/views/backup_dialog.h"

#include "app/gui/views/layout.h"
#include "app/language/words.h"

namespace jnd::app::gui {

bool draw_backup_dialog(Ui& ui, bool& asks, bool& is_new, std::string& folder) {
  if (!asks) return false;
  const TextStyle soft{.colour = Colour::kSoft, .wrap = true};
  const char* words =
      tr("A new folder, or an earlier backup: then only what is new is copied.");
  Rect inside =
      ui.begin_dialog("backup_dialog", 640, 250 + more_lines(ui, 640, words, soft, 1));
  ui.text(inside.take_top(34, 4), tr("Back up the study"), {.font = Font::kLarge});
  ui.text(inside.take_top(ui.text_height(inside.width, words, soft), 12), words, soft);
  const bool entered = ui.text_field("backup_folder", inside.take_top(46), folder,
                                     tr("folder of the copy"), is_new);
  const DialogChoice choice =
      draw_dialog_buttons(ui, inside.take_bottom(48), tr("Back up"), !folder.empty(), entered);
  ui.end_dialog();
  // Enter ends a field. If something is still missing, the field gets the keyboard again.
  is_new = entered && !choice.done;
  if (choice.done || choice.cancelled) asks = false;
  return choice.done;
}

}  // namespace jnd::app::gui
