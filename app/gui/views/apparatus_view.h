#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/scene_painter.h"
#include "app/gui/ui.h"
#include "app/gui/views/run_view.h"
#include "app/gui/views/scope_panel.h"

namespace jnd::app::gui {

/// Where the view gets what changes all the time. While levels are hidden, it asks neither
/// source.
struct ApparatusSources {
  /// Returns the last seconds of these channels; empty if there are none to show.
  std::function<ScopePicture(const std::vector<std::string>&)> scopes;
  /// Returns a texture that shows the apparatus, or 0 while that is still loading. The function
  /// is empty if no picture can be drawn.
  std::function<std::uintptr_t(const SceneRequest&)> paint;
  std::string paint_problem;  ///< Why no picture can be drawn; "" if that is not known.
};

struct ApparatusViewState {
  SceneCamera camera = camera_at_first();
  ScopePanelState scopes;
  /// What was on the screen when somebody chose "Hold", with every channel.
  struct Held {
    core::Sample sample;
    std::vector<std::string> names;
    ScopePicture scopes;
  };
  std::optional<Held> held;
};

/// Shows the apparatus instead of the run view's cards, for the experimenter alone: robot, hand
/// and forces in space, and scopes of any channel. Header, footer, dialogs and emergency stop
/// are those of the run view. Where levels are hidden, the view shows a notice instead, because
/// forces, speeds and paths would tell the levels.
[[nodiscard]] RunViewResult draw_apparatus_view(Ui& ui, const SessionView& view,
                                                const ApparatusSources& sources,
                                                RunViewState& run, ApparatusViewState& state);

}  // namespace jnd::app::gui
