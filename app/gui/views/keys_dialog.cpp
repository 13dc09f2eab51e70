#include "app/gui/views/keys_dialog.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

struct Line {
  std::string key, what;
};

std::vector<Line> lines_of(std::vector<Drawn::Widget> widgets) {
  std::vector<Line> lines = {{"Esc", tr("Emergency stop, from anywhere")},
                             {"Ctrl +  Ctrl -", tr("Larger, smaller")},
                             {"Ctrl D", tr("Dark or light")},
                             {"F9", tr("The participant's screen")},
                             {"F2", tr("Leave a dialog")},
                             {"Ctrl Q", tr("Leave the program")}};
  std::set<std::string> known = {"Esc", "F1", "Ctrl D", "Ctrl +"};
  // Line by line, from the left.
  std::ranges::stable_sort(widgets, {}, [](const Drawn::Widget& widget) {
    constexpr float kLine = 20;
    return std::pair(std::round(widget.place.y / kLine), widget.place.x);
  });
  for (const Drawn::Widget& widget : widgets) {
    if (widget.key.empty() || !known.insert(widget.key).second) continue;
    lines.push_back({widget.key, widget.label});
  }
  return lines;
}

}  // namespace

bool draw_keys_dialog(Ui& ui, std::vector<Drawn::Widget> widgets) {
  const std::vector<Line> lines = lines_of(std::move(widgets));
  constexpr float kLine = 30;
  constexpr float kAround = 2 * 28 + 34 + 8 + 44 + 8;  // Padding, title, button.
  const float room = ui.screen().height - 2 * 12 - kAround;
  const auto rows = static_cast<std::size_t>(std::max(1.0f, std::floor(room / kLine)));
  const std::size_t columns = (lines.size() + rows - 1) / rows;
  const std::size_t used = (lines.size() + columns - 1) / columns;
  Rect inside = ui.begin_dialog("keys", 120 + 420 * static_cast<float>(columns),
                                kAround + kLine * static_cast<float>(used));
  ui.text(inside.take_top(34, 8), tr("All keys"), {.font = Font::kLarge});
  const ButtonStyle close{.tone = Tone::kPrimary, .key = {Key::kF1}};
  Rect row = inside.take_bottom(44, 8);
  const float width = inside.width / static_cast<float>(columns);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t column = i / used;
    Rect place = {inside.x + width * static_cast<float>(column),
                  inside.y + kLine * static_cast<float>(i % used), width - 12, kLine};
    ui.text(place.take_left(140, 12), lines[i].key,
            {.font = Font::kMono, .colour = Colour::kSoft});
    ui.text(place, lines[i].what, {});
  }
  const bool closed =
      ui.button("keys_close", row.take_right(ui.button_width(tr("Close"), close)), tr("Close"),
                close) ||
      ui.pressed({Key::kF2});
  ui.end_dialog();
  return closed;
}

}  // namespace jnd::app::gui
