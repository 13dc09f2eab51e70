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

/// Begins with keys that have no control, and keys whose control says less than the line here.
std::vector<Line> lines_of(std::vector<Drawn::Widget> widgets) {
  const Chord larger = {.key = Key::kPlus, .control = true};
  const Chord smaller = {.key = Key::kMinus, .control = true};
  const Chord dark = {.key = letter('D'), .control = true};
  const Chord leave = {.key = letter('Q'), .control = true};
  std::vector<Line> lines = {
      {printed_words({Key::kEscape}), tr("Emergency stop, from anywhere")},
      {printed_words(larger) + "  " + printed_words(smaller), tr("Larger, smaller")},
      {printed_words(dark), tr("Dark or light")},
      {printed_words({Key::kF9}), tr("The participant's screen")},
      {printed_words({Key::kF2}), tr("Leave a dialog")},
      {printed_words({Key::kF3}), tr("Set an answer right, in a session")},
      {printed_words(leave), tr("Leave the program")}};
  std::set<std::string> known = {"", words({Key::kEscape}), words({Key::kF1}), words(dark),
                                 words(larger)};
  // Sorts the controls line by line, from the left.
  std::ranges::stable_sort(widgets, {}, [](const Drawn::Widget& widget) {
    constexpr float kLine = 20;
    return std::pair(std::round(widget.place.y / kLine), widget.place.x);
  });
  for (const Drawn::Widget& widget : widgets) {
    if (known.insert(widget.key).second) lines.push_back({widget.key_cap, widget.label});
  }
  return lines;
}

}  // namespace

KeysResult draw_keys_dialog(Ui& ui, std::vector<Drawn::Widget> widgets) {
  const std::vector<Line> lines = lines_of(std::move(widgets));
  constexpr float kLine = 30;
  constexpr float kAround = 2 * 28 + 34 + 8 + 44 + 8;  // Padding, title and button.
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
  float keys = 0;
  for (const Line& line : lines) keys = std::max(keys, ui.text_width(line.key, Font::kMono));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t column = i / used;
    Rect place = {inside.x + width * static_cast<float>(column),
                  inside.y + kLine * static_cast<float>(i % used), width - 12, kLine};
    ui.text(place.take_left(std::min(140.0f, keys + 2), 12), lines[i].key,
            {.font = Font::kMono, .colour = Colour::kSoft});
    // A button's label may have been written by somebody, so it may have any length.
    ui.text(place, lines[i].what, {.any_length = true});
  }
  KeysResult result;
  result.closed = ui.button("keys_close", row.take_right(ui.button_width(tr("Close"), close)),
                            tr("Close"), close) ||
                  ui.pressed({Key::kF2});
  const ButtonStyle manual{.key = {letter('H')}};
  row.take_right(12);
  result.opens_manual =
      ui.button("keys_manual", row.take_right(ui.button_width(tr("Manual"), manual)),
                tr("Manual"), manual);
  ui.end_dialog();
  return result;
}

}  // namespace jnd::app::gui
