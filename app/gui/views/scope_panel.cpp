#include "app/gui/views/scope_panel.h"

#include <algorithm>
#include <cmath>

#include "app/gui/views/layout.h"
#include "app/gui/views/scope_curve.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kRowHeight = 32;
constexpr float kInset = 8;
constexpr float kHead = 26;

ScopeChannel channel_named(const std::string& name) {
  const std::vector<ScopeChannel> all = scope_channels(true);
  const auto found = std::ranges::find(all, name, &ScopeChannel::name);
  return found == all.end() ? ScopeChannel{.name = name, .label = name} : *found;
}

std::string with_unit(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : label + " · " + unit;
}

std::string value_words(const ScopePoint& point, const std::string& unit) {
  if (!std::isfinite(point.low)) return tr("no number");
  const auto number = [&](double value) {
    return short_number(std::abs(value) < 0.01 * least_scope_span(unit) ? 0.0 : value);
  };
  std::string words = number(point.low);
  if (const std::string high = number(point.high); high != words)
    words = tr("{} to {}", words, high);
  return unit.empty() ? words : words + " " + unit;
}

/// Draws one scope and returns the place of its curve.
std::optional<PlotArea> draw_scope(Ui& ui, const Rect& place, int number,
                                   const std::vector<ScopePoint>& points,
                                   const ScopePicture& picture, ScopePanelState& state) {
  ui.card(place);
  Rect inside = place.inset(kInset);
  const Rect head = inside.take_top(kHead, 2);
  const std::string& name = state.channels[static_cast<std::size_t>(number)];
  const ScopeChannel channel = channel_named(name);
  const ButtonStyle style{.tone = Tone::kQuiet,
                          .key = {letter(static_cast<char>('1' + number))}};
  const std::string label =
      name.empty() ? tr("No channel") : with_unit(channel.label, channel.unit);
  const float width = std::min(ui.button_width(label, style), head.width * 0.62f);
  if (ui.button("scope_" + std::to_string(number + 1), {head.x, head.y, width, head.height},
                label, style)) {
    state.choosing = number;
    state.choosing_is_new = true;
    state.typed.clear();
    state.selected = 0;
  }
  if (name.empty()) return std::nullopt;
  if (points.empty()) {
    draw_notice(ui, inside, tr("No samples yet."));
    return std::nullopt;
  }
  PlotModel plot{.hover = false, .least_left = 46};
  plot.x = {.minimum = -kScopeSeconds, .maximum = 0.0, .tick_suffix = " s"};
  const AxisRange range = scope_range(points, channel.unit);
  plot.series.push_back(scope_curve(points, picture, inside, range));
  // There are at least two numbers, because a single one tells no scale.
  const int num_ticks = std::max(4, static_cast<int>(inside.height / 30));
  plot.y = {.unit = channel.unit, .minimum = range.low, .maximum = range.high};
  plot.y.ticks = linear_ticks(range, num_ticks);
  return draw_plot(ui, inside, plot);
}

/// Draws a value at the right end of the head: the one at the mouse's time, or the newest one.
void draw_value(Ui& ui, const Rect& place, const std::vector<ScopePoint>& points,
                const std::string& unit, std::optional<double> time_s) {
  if (points.empty()) return;
  const auto nearest = std::ranges::min_element(points, {}, [&](const ScopePoint& point) {
    return std::abs(point.time_s - time_s.value_or(points.back().time_s));
  });
  Rect head = place.inset(kInset).take_top(kHead);
  // Ends where the curve ends.
  head.take_right(12);
  ui.text(head.take_right(head.width * 0.37f), value_words(*nearest, unit),
          {.font = Font::kSmallStrong, .align = Align::kRight});
}

}  // namespace

void draw_scopes(Ui& ui, const Rect& place, const ScopePicture& picture,
                 ScopePanelState& state) {
  constexpr float kBetween = 10;
  const float height = (place.height - kBetween * (kNumScopes - 1)) / kNumScopes;
  Rect rest = place;
  std::array<Rect, kNumScopes> places;
  std::array<std::optional<PlotArea>, kNumScopes> areas;
  std::optional<double> time_s;
  static const std::vector<ScopePoint> kNoPoints;
  const auto points_of = [&](std::size_t scope) -> const std::vector<ScopePoint>& {
    return scope < picture.channels.size() ? picture.channels[scope] : kNoPoints;
  };
  for (std::size_t i = 0; i < kNumScopes; ++i) {
    places[i] = rest.take_top(height, kBetween);
    areas[i] = draw_scope(ui, places[i], static_cast<int>(i), points_of(i), picture, state);
    if (!areas[i] || !ui.hovered(areas[i]->place)) continue;
    const double ratio = (ui.mouse_x() - areas[i]->place.x) / areas[i]->place.width;
    time_s = picture.newest_s - kScopeSeconds * (1.0 - ratio);
  }
  for (std::size_t i = 0; i < kNumScopes; ++i) {
    if (!areas[i]) continue;
    const std::string unit = channel_named(state.channels[i]).unit;
    draw_value(ui, places[i], points_of(i), unit, time_s);
    if (!time_s) continue;
    const Rect& area = areas[i]->place;
    const float x = areas[i]->x(*time_s - picture.newest_s);
    ui.line(x, area.y, x, area.bottom(), Colour::kSoft);
    if (!ui.hovered(area)) continue;
    ui.tooltip(x, ui.mouse_y(), short_number(*time_s - picture.newest_s) + " s");
  }
}

void draw_channel_chooser(Ui& ui, bool with_joints, ScopePanelState& state) {
  if (!state.choosing) return;
  Rect inside =
      ui.begin_dialog("channel_chooser", 560, std::min(700.0f, ui.screen().height - 40));
  ui.text(inside.take_top(34, 10), tr("What should scope {} show?", *state.choosing + 1),
          {.font = Font::kLarge});
  const std::string before = state.typed;
  const bool entered =
      ui.text_field("channel_typed", inside.take_top(42, 10), state.typed,
                    tr("Part of a name, such as: index force"), state.choosing_is_new);
  state.choosing_is_new = false;
  if (state.typed != before) state.selected = 0;
  const Rect buttons = inside.take_bottom(44, 12);

  std::vector<ScopeChannel> offered =
      channels_matching(scope_channels(with_joints), state.typed);
  if (state.typed.empty()) offered.push_back({.label = tr("No channel")});
  const int count = static_cast<int>(offered.size());
  const int room = std::max(1, static_cast<int>(inside.height / kRowHeight));
  state.selected += (ui.pressed({Key::kDown}, true) ? 1 : 0) -
                    (ui.pressed({Key::kUp}, true) ? 1 : 0) +
                    (ui.pressed({Key::kPageDown}, true) ? room : 0) -
                    (ui.pressed({Key::kPageUp}, true) ? room : 0) -
                    static_cast<int>(ui.dragged("channel_list", inside).wheel);
  state.selected = std::clamp(state.selected, 0, std::max(0, count - 1));
  const int first = std::clamp(state.selected - room / 2, 0, std::max(0, count - room));
  std::optional<std::string> chosen;
  for (int i = first; i < std::min(count, first + room); ++i) {
    const ScopeChannel& channel = offered[static_cast<std::size_t>(i)];
    const Rect line = inside.take_top(kRowHeight);
    if (i == state.selected) ui.fill(line, Colour::kBlueSoft, 6);
    if (ui.row("channel_" + channel.name, line, channel.label)) chosen = channel.name;
    const Rect words = line.inset(0).middle(line.width - 24, ui.line_height(Font::kBody));
    draw_name_and_value(ui, words, channel.label,
                        {.colour = i == state.selected ? Colour::kBlue : Colour::kInk},
                        channel.unit, {.colour = Colour::kSoft});
  }
  if (count == 0) draw_notice(ui, inside, tr("No channel has all of these words in its name."));
  float x = buttons.x;
  for (const Key key : {Key::kUp, Key::kDown}) {
    x += ui.key_cap(x, buttons.y + 12, {key}) + 6;
  }
  ui.text({x + 4, buttons.y, 100, buttons.height}, tr("choose"),
          {.font = Font::kSmall, .colour = Colour::kSoft});
  const DialogChoice choice = draw_dialog_buttons(ui, buttons, tr("Show"), count > 0, entered);
  if (choice.done) chosen = offered[static_cast<std::size_t>(state.selected)].name;
  if (chosen) state.channels[static_cast<std::size_t>(*state.choosing)] = *chosen;
  if (chosen || choice.cancelled) state.choosing.reset();
  ui.end_dialog();
}

}  // namespace jnd::app::gui
