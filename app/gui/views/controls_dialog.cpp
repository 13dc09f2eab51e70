#include "app/gui/views/controls_dialog.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr float kActionRow = 34, kDeviceRow = 28;
constexpr std::size_t kActionColumns = 3;

std::int64_t monotonic_ns() {
  using std::chrono::duration_cast;
  using std::chrono::nanoseconds;
  return duration_cast<nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string chosen_action(const ControlsState& state) {
  return std::string(core::kControlActions[state.chosen]);
}

/// Draws one action: a light, what the action does, and which control does it.
void draw_action(Ui& ui, const Rect& place, std::size_t index, const core::ControlMap& map,
                 ControlsState& state) {
  const std::string action(core::kControlActions[index]);
  const core::Control* control = map.control_of(action);
  const bool is_lit = control != nullptr && state.down.contains(*control);
  if (index == state.chosen) {
    ui.fill(place, Colour::kBlueSoft, 8);
    ui.outline(place, Colour::kBlue, 8);
  }
  const std::string does = action_words(action);
  const std::string by = control == nullptr ? "" : core::words_of(*control);
  if (ui.row("control_" + action, place, does + (by.empty() ? "" : ": " + by)) &&
      !state.waits && !state.asks_about) {
    state.chosen = index;
  }
  Rect inside = place;
  inside.take_left(4);
  inside.take_right(4);
  const Rect light = inside.take_left(22);
  const float x = light.x + 11, y = light.y + light.height / 2;
  if (is_lit) {
    ui.dot(x, y, 6, Colour::kGreen);
  } else if (control != nullptr) {
    ui.ring(x, y, 5, Colour::kSoft);
  }
  ui.text(inside.take_left(inside.width * 0.48f, 8), does, {.font = Font::kSmall});
  const bool waits = state.waits && index == state.chosen;
  ui.text(inside, waits ? tr("press it now …") : by,
          {.font = Font::kSmall,
           .colour = waits    ? Colour::kBlue
                     : is_lit ? Colour::kGreen
                              : Colour::kSoft,
           .any_length = !waits});
}

std::string device_words(const core::ControlReader::DeviceState& device) {
  if (!device.problem.empty()) return device.problem;
  if (device.is_ours) return tr("mapped, and ours alone");
  if (device.is_mapped) return tr("mapped; ours alone once nothing on it is held");
  return tr("listened to");
}

void draw_devices_of_controls(Ui& ui, Rect place,
                              const std::vector<core::ControlReader::DeviceState>& devices) {
  ui.heading(place.take_top(18, 6), tr("What is plugged in"));
  if (devices.empty()) {
    ui.text(place.take_top(kDeviceRow),
            tr("Nothing that can be read. `jnd devices` lists what there is."),
            {.font = Font::kSmall, .colour = Colour::kSoft});
  }
  for (const core::ControlReader::DeviceState& device : devices) {
    Rect row = place.take_top(kDeviceRow);
    ui.text(row.take_left(row.width * 0.4f, 12), device.device,
            {.font = Font::kSmall, .any_length = true});
    ui.text(row, device_words(device),
            {.font = Font::kSmall,
             .colour = device.problem.empty() ? Colour::kSoft : Colour::kAmber});
  }
}

/// The words above the buttons: a question about a device that may be the keyboard, or what was
/// pressed.
std::string what_happens(const ControlsState& state) {
  if (state.asks_about) {
    return tr(
        "{} has the keys of a whole keyboard, as many pedals have. While a session is prepared "
        "or runs, nothing on it types; Esc on it stays the emergency stop. Is it a pedal or a "
        "pad, not the keyboard that you type on?",
        state.asks_about->device);
  }
  if (state.waits) {
    return tr("Press the pedal or the button for “{}”. F2 leaves it as it was.",
              action_words(chosen_action(state)));
  }
  return state.newest ? tr("Pressed last: {}.", core::words_of(*state.newest))
                      : std::string(tr("Press anything to try it: its line lights up."));
}

void draw_what_happens(Ui& ui, const Rect& place, const ControlsState& state) {
  ui.text(place, what_happens(state),
          {.font = Font::kSmall,
           .colour = state.asks_about ? Colour::kAmber : Colour::kSoft,
           .wrap = true});
}

}  // namespace

std::optional<core::Control> take_presses(
    ControlsState& state, const std::vector<core::ControlEvent>& events,
    const std::vector<core::ControlReader::DeviceState>& devices) {
  std::optional<core::Control> mapped;
  for (const core::ControlEvent& event : events) {
    if (!event.is_down) {
      state.down.erase(event.control);
      continue;
    }
    state.down.insert(event.control);
    state.newest = event.control;
    if (!state.waits || event.monotonic_ns < state.waits_from_ns) continue;
    state.waits = false;
    const auto device = std::ranges::find(devices, event.control.device,
                                          &core::ControlReader::DeviceState::device);
    if (device != devices.end() && device->is_keyboard && !device->is_mapped) {
      state.asks_about = event.control;
    } else {
      mapped = event.control;
    }
  }
  return mapped;
}

ControlsResult draw_controls_dialog(
    Ui& ui, const core::ControlMap& map,
    const std::vector<core::ControlReader::DeviceState>& devices,
    const std::optional<core::Control>& mapped, ControlsState& state) {
  ControlsResult result;
  if (mapped) result.mapped = {chosen_action(state), *mapped};
  constexpr std::size_t kRows =
      (core::kControlActions.size() + kActionColumns - 1) / kActionColumns;
  // The corner has to remain visible.
  const float room = ui.screen().height - 100;
  Rect inside = ui.begin_dialog("controls", std::min(1240.0f, ui.screen().width - 24),
                                std::min(room, 700.0f));
  ui.text(inside.take_top(34, 2), tr("Pedals and buttons"), {.font = Font::kLarge});
  const TextStyle soft{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  const char* kept =
      tr("Kept on this machine, for every study. A mapped device does nothing else while a "
         "session is prepared or runs.");
  ui.text(inside.take_top(ui.text_height(inside.width, kept, soft), 8), kept, soft);
  Rect buttons = inside.take_bottom(44, 10);
  const float happening = ui.text_height(inside.width, what_happens(state), soft);
  const Rect happens = inside.take_bottom(std::max(58.0f, happening), 6);
  const float of_actions = static_cast<float>(kRows) * kActionRow + 14;
  const float of_devices =
      18 + 6 + kDeviceRow * static_cast<float>(std::max<std::size_t>(1, devices.size()));
  inside = ui.begin_scroll("controls_and_devices", inside, of_actions + of_devices);
  Rect actions = inside.take_top(of_actions - 14, 14);
  const float width = (actions.width - 12) / static_cast<float>(kActionColumns);
  for (std::size_t i = 0; i < core::kControlActions.size(); ++i) {
    const std::size_t column = i / kRows, row = i % kRows;
    const Rect place{actions.x + static_cast<float>(column) * (width + 12),
                     actions.y + static_cast<float>(row) * kActionRow, width, kActionRow - 2};
    draw_action(ui, place, i, map, state);
  }
  draw_devices_of_controls(ui, inside, devices);
  ui.end_scroll();
  draw_what_happens(ui, happens, state);

  const auto button = [&](const char* name, const char* label, const ButtonStyle& style) {
    return ui.button(name, buttons.take_right(ui.button_width(label, style), 12), label, style);
  };
  if (state.asks_about) {
    if (button("control_confirm", tr("Map it"),
               {.tone = Tone::kPrimary, .key = {Key::kEnter}})) {
      result.mapped = {chosen_action(state), *state.asks_about};
      state.asks_about.reset();
    } else if (button("control_refuse", tr("Leave it alone"), {.key = {Key::kF2}})) {
      state.asks_about.reset();
    }
  } else if (state.waits) {
    if (button("control_cancel", tr("Cancel"), {.key = {Key::kF2}})) state.waits = false;
  } else {
    const bool is_mapped = map.control_of(chosen_action(state)) != nullptr;
    if (button("control_map", tr("Press to map"),
               {.tone = Tone::kPrimary, .key = {Key::kEnter}})) {
      state.waits = true;
      state.waits_from_ns = monotonic_ns();
    }
    if (button("control_forget", tr("Forget"), {.key = {Key::kDelete}, .enabled = is_mapped})) {
      result.forgotten = chosen_action(state);
    }
    if (button("controls_close", tr("Close"), {.key = {Key::kF2}})) result.is_closed = true;
    const std::size_t last = core::kControlActions.size() - 1;
    if (ui.pressed({Key::kDown}, true)) state.chosen = std::min(state.chosen + 1, last);
    if (ui.pressed({Key::kUp}, true)) state.chosen -= std::min<std::size_t>(state.chosen, 1);
  }
  ui.end_dialog();
  return result;
}

}  // namespace jnd::app::gui
