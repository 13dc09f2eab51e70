#include "app/open_window.h"

#include <cstdlib>
#include <string>

#include "app/command.h"
#include "app/gui/application.h"
#include "app/gui/window.h"
#include "core/error.h"

namespace jnd::app {

bool has_display() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

namespace {

/// Lets the window and the application know of each other.
void show(gui::Window& window, const WindowRequest& request) {
  gui::Application application(request, [&window] { window.wake(); });
  window.on_escape = [&] { application.escape(); };
  window.on_iteration = [&] {
    application.beat();
    window.wants_iterations(application.is_live());
    window.wants_frames(application.is_live() || application.works());
  };
  window.on_mouse_moved = [&](float x, float y) { application.cursor(x, y); };
  window.run([&](gui::Ui& ui) {
    if (window.close_requested()) application.ask_to_close();
    ui.set_view(application.view_name());
    application.draw(ui);
    if (application.shows_participant() != window.second_is_open()) {
      if (application.shows_participant()) {
        window.open_second("jnd: participant",
                           [&](gui::Ui& second) { application.draw_participant(second); });
      } else {
        window.close_second();
      }
    }
    if (const auto file = application.take_picture_request()) {
      window.save_picture(*file, std::nullopt, [](const std::string&) {});
    }
    if (application.zoom() != window.zoom()) window.set_zoom(application.zoom());
    if (application.closed()) window.close();
  });
}

}  // namespace

int open_window(const WindowRequest& request) {
  if (!has_display()) {
    throw EnvironmentError(
        "no display was found for the window; use --headless where a command has it, `jnd "
        "--help` lists what works without one");
  }
  try {
    gui::Window window;
    show(window, request);
  } catch (const core::Error& error) {
    const std::string what = error.what();
    if (what.starts_with("no display was found")) throw EnvironmentError(what);
    throw;
  }
  return kDone;
}

}  // namespace jnd::app
