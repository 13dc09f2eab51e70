#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "app/gui/plot.h"
#include "app/gui/views/layout.h"
#include "app/operator/results_model.h"

namespace jnd::app::gui {

// What the pages of figures share: a card a block, with its plot and what that comes to.

/// The plot, and below it why it comes to nothing.
void draw_without_value(Ui& ui, Rect inside, const PlotModel& plot, const std::string& why);

/// Of `draw_value`.
[[nodiscard]] float value_height(Ui& ui, float width, const analysis::Chart& chart);
/// The number in large letters, then what belongs to it, below where one line has no room.
void draw_value(Ui& ui, Rect line, const std::string& value, const std::string& detail);

/// As many side by side as have room; scrolls where there are more rows than that.
template <typename Item, typename Draw>
void draw_grid(Ui& ui, const char* name, const Rect& place, const std::vector<Item>& items,
               float least_width, float least_height, const Draw& draw) {
  const auto count = static_cast<int>(items.size());
  const int most = std::max(1, static_cast<int>((place.width + kGap) / (least_width + kGap)));
  const int columns = std::min(count, most);
  const int num_rows = (count + columns - 1) / columns;
  const auto rows = static_cast<float>(num_rows);
  const float height = std::max(least_height, (place.height - kGap * (rows - 1)) / rows);
  const Rect inside = ui.begin_scroll(name, place, rows * (height + kGap) - kGap);
  const std::vector<Rect> cards = grid_of(inside, count, columns, height);
  for (std::size_t i = 0; i < cards.size(); ++i) draw(cards[i], items[i]);
  ui.end_scroll();
}

}  // namespace jnd::app::gui
