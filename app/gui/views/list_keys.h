#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "app/gui/ui.h"

namespace jnd::app::gui {

// How lists are gone through by keyboard and mouse, the same everywhere.

/// Up and Down go through a list, and stop at its ends; the first press chooses an end. Returns
/// whether another row was chosen.
bool move_in_list(Ui& ui, std::size_t count, std::optional<std::size_t>& selected);

/// Cuts the caps of the two keys off the right end of a strip and draws them.
void draw_list_keys(Ui& ui, Rect& strip);

/// Tells a second click on the same thing from the first.
class DoubleClick {
 public:
  /// True for the second of two clicks on `name` within half a second. `now_s`: of the frames.
  bool clicked(const std::string& name, double now_s);

 private:
  std::string name_;
  double at_s_ = 0.0;
};

}  // namespace jnd::app::gui
