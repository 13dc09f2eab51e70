#include "app/command_line/open_window.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line/command.h"
#include "app/command_line/stop_signals.h"
#include "app/gui/application/application.h"
#include "app/gui/scene_painter.h"
#include "app/gui/scene_thread.h"
#include "app/gui/window.h"
#include "app/language/words.h"
#include "app/operator/recent_studies.h"
#include "app/operator/remembered_language.h"
#include "app/session/shipped_files.h"
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

/// The folder where the window keeps what it remembers; "" if the user has no home folder.
std::filesystem::path state_folder() {
  const std::filesystem::path recent = RecentStudies::default_file();
  return recent.empty() ? std::filesystem::path() : recent.parent_path();
}

/// Opens, moves or closes the participant's window as the application wants it.
void show_participant(gui::Window& window, gui::Application& application) {
  const ScreenPlace& place = application.participant_place();
  if (place.nowhere) return window.close_second();
  try {
    window.open_second(
        tr("jnd: participant"),
        [&application](gui::Ui& second) { application.draw_participant(second); },
        place.monitor);
  } catch (const core::Error& error) {
    application.lose_participant(error.what());
  }
}

/// Draws the apparatus on a thread of its own, which holds the OpenGL context as long as this
/// object exists.
class DrawnScene {
 public:
  explicit DrawnScene(gui::SharedContext& context) : current_(context) {}
  std::uintptr_t paint(const gui::SceneRequest& request, double now_s) {
    return painter_.paint(request, now_s);
  }

 private:
  struct Current {
    explicit Current(gui::SharedContext& its_context) : context(its_context) {
      context.make_current();
    }
    ~Current() { context.let_go(); }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    gui::SharedContext& context;
  };
  Current current_;
  gui::ScenePainter painter_;
};

std::unique_ptr<gui::SceneThread> begin_scene(gui::SharedContext& context,
                                              gui::Window& window) {
  return std::make_unique<gui::SceneThread>(
      [&context]() -> gui::SceneThread::Paint {
        return [scene = std::make_shared<DrawnScene>(context)](const gui::SceneRequest& request,
                                                               double now_s) {
          return scene->paint(request, now_s);
        };
      },
      [&window] { window.wake(); });
}

/// Connects the window and the application, and shows them. Returns the language that somebody
/// chose, in which the window is to begin anew; "" if the window was closed.
std::string show(gui::Window& window, const WindowRequest& request) {
  // Both are made when the apparatus is first looked at, and are gone before OpenGL is.
  std::unique_ptr<gui::SharedContext> scene_context;
  std::unique_ptr<gui::SceneThread> scene;
  gui::Application application(request, [&window] { window.wake(); });
  application.set_zoom(window.zoom());
  application.offer(languages_in(languages_folder()));
  application.set_scene_painter([&](const gui::SceneRequest& request) {
    if (scene == nullptr) {
      scene_context = window.make_shared_context();
      scene = begin_scene(*scene_context, window);
    }
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return scene->paint(request, std::chrono::duration<double>(now).count());
  });
  window.on_escape = [&] { application.escape(); };
  window.on_key_changed = [&](gui::Key key, bool is_down) {
    application.key_changed(key, is_down);
  };
  window.on_iteration = [&] {
    application.beat(window.is_in_sight());
    if (stop_requested() && !application.closed()) {
      application.end_soon();
      window.wake();
    }
    if (application.look_beside()) window.wake();
    window.wants_iterations(application.is_live());
    window.wants_frames(application.is_live() || application.works());
  };
  window.on_mouse_pressed = [&](float x, float y) { application.mouse_pressed(x, y); };
  window.on_mouse_moved = [&](float x, float y) { application.cursor(x, y); };
  window.on_dropped = [&](const std::vector<std::filesystem::path>& paths) {
    if (!paths.empty()) application.dropped(paths.front());
  };
  window.run([&](gui::Ui& ui) {
    if (window.close_requested()) application.ask_to_close();
    if (window.second_close_requested()) application.hide_participant();
    application.set_monitors(window.monitors());
    ui.set_view(application.view_name());
    application.draw(ui);
    show_participant(window, application);
    if (application.zoom() != window.zoom()) window.set_zoom(application.zoom());
    if (application.closed()) window.close();
  });
  window.close_second();
  return application.wanted_language();
}

/// Shows the window in the language that was chosen last, again and again until it is closed.
void show_in_languages(gui::Window& window, WindowRequest request) {
  for (;;) {
    const std::string language = show(window, request);
    if (language.empty()) return;
    remember_language(state_folder(), language);
    begin_language(languages_folder(), language);
    // The language was chosen on the start screen, so the window begins there again.
    request.study_folder.clear();
    request.resume_session.reset();
  }
}

}  // namespace

int open_window(const WindowRequest& request) {
  if (!has_display()) {
    throw EnvironmentError(
        "no display was found for the window; use --headless where a command has it, `jnd "
        "--help` lists what works without one");
  }
  begin_language(languages_folder(), remembered_language(state_folder()));
  try {
    gui::Window window;
    stop_on_signals();
    show_in_languages(window, request);
    if (stop_requested()) {
      std::fputs(
          "jnd: told to end; every answer is on disk, and a session under way can be resumed\n",
          stderr);
    }
  } catch (const core::Error& error) {
    const std::string what = error.what();
    if (what.starts_with("no display was found")) throw EnvironmentError(what);
    throw;
  }
  return kDone;
}

}  // namespace jnd::app
