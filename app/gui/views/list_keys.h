#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "app/gui/ui.h"

namespace jnd::app::gui {

// How keyboard and mouse move through lists, the same everywhere.

/// Moves through a list by the keys Up and Down, and stops at its ends; the first press chooses
/// an end. Returns true if another row was chosen.
bool move_in_list(Ui& ui, std::size_t count, std::optional<std::size_t>& selected);

/// Cuts room for the caps of the two keys off the right end of a strip, and draws them.
void draw_list_keys(Ui& ui, Rect& strip);

/// Distinguishes the second click on the same thing from the first.
class DoubleClick {
 public:
  /// Returns true for the second of two clicks on `name` within half a second. `now_s` is the
  /// frames' time.
  bool clicked(const std::string& name, double now_s);

 private:
  std::string name_;
  double at_s_ = 0.0;
};

}  // namespace jnd::app::gui
