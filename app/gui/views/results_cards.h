#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "app/gui/plot.h"
#include "app/gui/views/layout.h"
#include "app/operator/results_model.h"

namespace jnd::app::gui {

// What the pages of figures share: a card for each block, with its plot and its result.

/// Draws the plot, and below it why there is no value.
void draw_without_value(Ui& ui, Rect inside, const PlotModel& plot, const std::string& why);

/// The height that `draw_value` needs.
[[nodiscard]] float value_height(Ui& ui, float width, const analysis::Chart& chart);
/// Draws the number in large letters, followed by its detail; the detail is below if one line
/// has no room.
void draw_value(Ui& ui, Rect line, const std::string& value, const std::string& detail);

/// Draws as many cards side by side as have room. The page scrolls if it has too many rows.
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
