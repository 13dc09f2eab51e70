#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/answer_controls.h"

namespace jnd::app::gui {

/// The state of the dialog that maps pedals and buttons to actions.
struct ControlsState {
  bool is_open = false;
  std::size_t chosen = 0;          ///< The chosen action's index in `core::kControlActions`.
  bool waits = false;              ///< The dialog waits for a press to map.
  std::int64_t waits_from_ns = 0;  ///< CLOCK_MONOTONIC; earlier presses do not count.
  /// A press on a device that may be the keyboard that somebody types on. The dialog asks
  /// whether it was meant.
  std::optional<core::Control> asks_about;
  std::set<core::Control> down;         ///< The controls that are held now.
  std::optional<core::Control> newest;  ///< The control that was pressed last.
};

struct ControlsResult {
  std::optional<std::pair<std::string, core::Control>> mapped;  ///< Action and control.
  std::optional<std::string> forgotten;
  bool is_closed = false;
};

/// Takes what was pressed since the last frame; returns the control if a press has mapped one.
[[nodiscard]] std::optional<core::Control> take_presses(
    ControlsState& state, const std::vector<core::ControlEvent>& events,
    const std::vector<core::ControlReader::DeviceState>& devices);

/// Draws the dialog: each action with the control that is mapped to it, lit while that is held,
/// and the devices that are plugged in. `mapped` is what `take_presses` returned in this frame.
[[nodiscard]] ControlsResult draw_controls_dialog(
    Ui& ui, const core::ControlMap& map,
    const std::vector<core::ControlReader::DeviceState>& devices,
    const std::optional<core::Control>& mapped, ControlsState& state);

}  // namespace jnd::app::gui
