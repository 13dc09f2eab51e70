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

/// What is being mapped, as it stands in the dialog.
struct ControlsState {
  bool is_open = false;
  std::size_t chosen = 0;  ///< The action, of `core::kControlActions`.
  bool waits = false;      ///< For a press that is to do it.
  std::int64_t waits_from_ns =
      0;  ///< Of CLOCK_MONOTONIC: what was pressed before is not meant.
  /// Pressed, on a device that may be the keyboard that somebody types on: is it meant?
  std::optional<core::Control> asks_about;
  std::set<core::Control> down;         ///< What is held now.
  std::optional<core::Control> newest;  ///< What was pressed last.
};

struct ControlsResult {
  std::optional<std::pair<std::string, core::Control>> mapped;  ///< Action and control.
  std::optional<std::string> forgotten;
  bool is_closed = false;
};

/// Takes what was pressed since the frame before; returns the control that a press has mapped.
[[nodiscard]] std::optional<core::Control> take_presses(
    ControlsState& state, const std::vector<core::ControlEvent>& events,
    const std::vector<core::ControlReader::DeviceState>& devices);

/// Over everything: each action with what is mapped to it, lit while that is held, and the
/// devices that are there. `mapped`: what `take_presses` returned in this frame.
[[nodiscard]] ControlsResult draw_controls_dialog(
    Ui& ui, const core::ControlMap& map,
    const std::vector<core::ControlReader::DeviceState>& devices,
    const std::optional<core::Control>& mapped, ControlsState& state);

}  // namespace jnd::app::gui
