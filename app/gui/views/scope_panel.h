#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/operator/scope_channels.h"
#include "app/operator/scope_trace.h"

namespace jnd::app::gui {

inline constexpr int kNumScopes = 4;

struct ScopePanelState {
  /// The channels by name; "" shows nothing.
  std::array<std::string, kNumScopes> channels = {"palm_inner_position_x_m",
                                                  "palm_inner_velocity_x_m_per_s",
                                                  "palm_inner_force_x_n", "index_force_x_n"};
  std::optional<int> choosing;  ///< The scope whose channel is being chosen.
  bool choosing_is_new = false;
  std::string typed;
  int selected = 0;  ///< The chosen one among the channels that match.
};

/// Draws the scopes below each other, with the newest value at the right end. While the mouse
/// is over one of them, all show their values at that time. `picture` holds the channels in
/// `state.channels`.
void draw_scopes(Ui& ui, const Rect& place, const ScopePicture& picture,
                 ScopePanelState& state);

/// Draws the dialog that asks for a scope's channel, while `state.choosing` is set.
void draw_channel_chooser(Ui& ui, bool with_joints, ScopePanelState& state);

}  // namespace jnd::app::gui
