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

/// Where the view gets what changes all the time. Neither is asked while levels are hidden.
struct ApparatusSources {
  /// The last seconds of these channels; empty where there are none.
  std::function<ScopePicture(const std::vector<std::string>&)> scopes;
  /// A texture that shows it, 0 while that is still loaded; empty where no picture can be
  /// drawn.
  std::function<std::uintptr_t(const SceneRequest&)> paint;
  std::string paint_problem;  ///< Why not; "" for no reason known.
};

struct ApparatusViewState {
  SceneCamera camera = camera_at_first();
  ScopePanelState scopes;
  /// What stood there when somebody said "Hold", with every channel.
  struct Held {
    core::Sample sample;
    std::vector<std::string> names;
    ScopePicture scopes;
  };
  std::optional<Held> held;
};

/// The apparatus under way instead of the run view's cards, for the experimenter alone: robot,
/// hand and forces in space, and scopes of any channel. Header, footer, dialogs and emergency
/// stop are those of the run view. Where levels are hidden it says so, for forces, speeds and
/// paths would tell them.
[[nodiscard]] RunViewResult draw_apparatus_view(Ui& ui, const SessionView& view,
                                                const ApparatusSources& sources,
                                                RunViewState& run, ApparatusViewState& state);

}  // namespace jnd::app::gui
